"""What a variant is, and the judgement of what a program made of it."""
from dataclasses import dataclass, field
from typing import Callable, List, Optional


@dataclass
class Variant:
    """One altered recording.

    change(recording) alters the copy of the clean recording `base` in place; make(folder, recording), for
    recordings that are no bag, writes a folder and returns (arguments of import_sequence, folder).
    """
    name: str
    change: Optional[Callable] = None
    names: str = ''          # what a message must name (regular expression) when the path is wrong
    right: bool = False      # a refusal would be a fault
    base: str = 'clean'
    make: Optional[Callable] = None
    damage: Optional[Callable] = None   # damage(path of the bag), after it has been written
    stamps: str = 'own'      # 'own': poses are compared at their stamps; 'end': only the last one
    arguments: List[str] = field(default_factory=list)  # of evaluate
