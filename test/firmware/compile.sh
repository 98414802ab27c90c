#!/usr/bin/env bash
# Compile the firmware for the Arduino Mega as its user would, with warnings as errors, and hold it against the controller's memory.
#
#   test/firmware/compile.sh SKETCH.ino      status 77 where avr-g++ is missing (gcc-avr, avr-libc)
set -euo pipefail
sketch=$(realpath "$1")
command -v avr-g++ >/dev/null || { echo "avr-g++ is not installed: sudo apt-get install gcc-avr avr-libc"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags=(-std=gnu++11 -mmcu=atmega2560 -DF_CPU=16000000UL -Os -Wall -Wextra -Werror -ffunction-sections -fdata-sections)
avr-g++ "${flags[@]}" -x c++ -c "$sketch" -o "$work/sketch.o"
avr-g++ "${flags[@]}" -c "$(dirname "${BASH_SOURCE[0]}")/main.cpp" -o "$work/main.o"
avr-g++ "${flags[@]}" -Wl,--gc-sections "$work/sketch.o" "$work/main.o" -o "$work/firmware.elf"
read -r text data bss _ < <(avr-size "$work/firmware.elf" | tail -1)
echo "flash $((text + data)) of 253952 bytes, RAM $((data + bss)) of 8192 bytes"
# The stack needs some of the RAM, above all for one message of each kind.
[[ $((text + data)) -lt 200000 && $((data + bss)) -lt 6000 ]]
