#!/usr/bin/env bash
# Runs a command inside a small virtual machine that has real V4L2 cameras, on a host that needs none.
#
#   test/v4l2/vm.sh [--out DIR] [--seconds N] [--skip-idle] -- COMMAND...
#   test/v4l2/vm.sh --check
#
# The machine boots Debian's own kernel under software emulation (no KVM needed; about 5 s), sees this host's root file
# system read-only with a RAM overlay on top, and owns
#   /dev/video0 /dev/video1    two `vivid` test cameras, with error injection through their controls
#   /dev/video10 /dev/video11  two `v4l2loopback` devices, which show what is written into them
# COMMAND runs as root in the current folder. DIR (default: a temporary one) is the one place that it can write to and
# the host sees, as /vm-out. Its exit status is passed on; 124 when it does not end within N (300) seconds, or the machine
# ends before.
# --skip-idle lets the machine's clock jump while nothing is to be done until a timer goes off. Not for programs that read
# much from files, since then it jumps while they wait for the host, too.
# --check ends with status 0 when everything needed is there, else says what is missing.
#
# There is no udev in the machine, hence no /dev/v4l/by-*; vivid's cameras belong to one driver and have no MJPG;
# v4l2loopback does not say of which clock its stamps are.
#
# Needs the test packages of scripts/install_dependencies.sh. The kernel and the loopback module's source are fetched
# by apt-get once, the module built, and both kept in $V4L2_VM_CACHE (default ~/.cache/stereo_nav/v4l2-vm).
set -euo pipefail

# The machine is made anew when this script changes.
version=$(sha256sum "${BASH_SOURCE[0]}" | cut -c1-16)
cache=${V4L2_VM_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/stereo_nav/v4l2-vm}
out="" seconds=300 idle=on

# The release whose headers are installed, e.g. 6.1.0-13-amd64.
kernel_release() {
  local folder
  folder=$(find /usr/src -maxdepth 1 -name 'linux-headers-*-amd64' 2>/dev/null | sort -V | tail -n 1)
  [[ -n $folder ]] && echo "${folder#/usr/src/linux-headers-}"
}

is_ready() { [[ $(cat "$cache/ready" 2>/dev/null) == "$version" ]]; }

missing_parts() {
  local tool
  for tool in qemu-system-x86_64 busybox cpio depmod modprobe make gcc apt-get flock; do
    command -v "$tool" >/dev/null || echo "$tool"
  done
  is_ready || kernel_release >/dev/null || echo "linux-headers-amd64 (Debian 12)"
}

# list_modules ROOT RELEASE NAME...: files of the modules and what they need, in the order of loading.
list_modules() {
  local root=$1 release=$2 module
  shift 2
  for module in "$@"; do
    modprobe -d "$root" -S "$release" --show-depends "$module" | awk '/^insmod/ {print $2}'
  done | awk '!seen[$0]++'
}

write_init() {
  cat >"$1" <<'INIT'
#!/bin/busybox sh
b=/bin/busybox
$b mount -t proc proc /proc; $b mount -t sysfs sys /sys; $b mount -t devtmpfs dev /dev
for m in $($b cat /mods/order); do
  case $m in
    vivid.ko) $b insmod /mods/$m n_devs=2 node_types=0x1,0x1 ;;
    v4l2loopback.ko) $b insmod /mods/$m devices=2 max_buffers=8 video_nr=10,11 card_label=left,right ;;
    *) $b insmod /mods/$m ;;
  esac
done
$b mount -t 9p -o trans=virtio,version=9p2000.L,msize=524288,ro,cache=loose host /lower
$b mount -t tmpfs tmpfs /upper; $b mkdir /upper/u /upper/w
$b mount -t overlay -o lowerdir=/lower,upperdir=/upper/u,workdir=/upper/w overlay /newroot
$b mkdir -p /newroot/vm-out
$b mount -t 9p -o trans=virtio,version=9p2000.L,msize=524288 out /newroot/vm-out
$b mount --move /dev /newroot/dev; $b mount --move /proc /newroot/proc; $b mount --move /sys /newroot/sys
$b mkdir -p /newroot/dev/shm /newroot/dev/pts; $b mount -t tmpfs shm /newroot/dev/shm; $b mount -t devpts pts /newroot/dev/pts
$b ip link set lo up; $b hostname localhost
exec $b switch_root /newroot /bin/bash /vm-out/.run
INIT
  chmod +x "$1"
}

# Kernel, modules and initial file system into $cache.
prepare() {
  local release work=$cache/work ramfs=$cache/work/ramfs file
  release=$(kernel_release)
  rm -rf "$work"
  mkdir -p "$ramfs"/{bin,mods,proc,sys,dev,lower,upper,newroot}
  # Root's apt warns that it does not drop its rights for a folder of root's.
  (cd "$work" && apt-get -o APT::Sandbox::User=root download -qq "linux-image-$release" v4l2loopback-dkms >/dev/null)
  for file in "$work"/*.deb; do dpkg -x "$file" "$work/root"; done
  cp -r "$work"/root/usr/src/v4l2loopback-* "$work/loopback"
  make -s -C "/usr/src/linux-headers-$release" M="$work/loopback" modules >"$work/module.log" 2>&1
  depmod -b "$work/root" "$release"
  while read -r file; do
    cp "$file" "$ramfs/mods/"
    basename "$file" >>"$ramfs/mods/order"
  done < <(list_modules "$work/root" "$release" virtio_pci 9p 9pnet_virtio overlay videodev vivid)
  cp "$work/loopback/v4l2loopback.ko" "$ramfs/mods/"
  echo v4l2loopback.ko >>"$ramfs/mods/order"
  cp "$(command -v busybox)" "$ramfs/bin/busybox"
  write_init "$ramfs/init"
  (cd "$ramfs" && find . | cpio -o -H newc 2>/dev/null | gzip) >"$cache/initrd.gz"
  cp "$work/root/boot/vmlinuz-$release" "$cache/vmlinuz"
  rm -rf "$work"
  echo "$version" >"$cache/ready"
}

# Runs the machine; 124 when it had to be stopped. Its clock counts instructions, one a nanosecond, and follows the host's
# only while it idles: however slow the emulation is, to the programs the machine is as fast as a computer, and no stream of
# images arrives late. That needs one core; it would need one in any case, since with two the emulation spends most of its time
# on keeping them in step. Without tsc the kernel distrusts that clock and asks an emulated device for the time.
boot() {
  timeout "$seconds" qemu-system-x86_64 -machine q35 -accel tcg -icount "shift=0,sleep=$idle" -cpu max -smp 1 -m 4096 -nographic \
    -no-reboot -kernel "$cache/vmlinuz" -initrd "$cache/initrd.gz" \
    -append "console=ttyS0 quiet panic=-1 no_timer_check tsc=reliable clocksource=tsc mitigations=off" \
    -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
    -virtfs "local,path=$out,mount_tag=out,security_model=none" </dev/null >"$out/console" 2>&1
}

while [[ $# -gt 0 ]]; do
  case $1 in
    --out) out=$2 && shift 2 ;;
    --skip-idle) idle=off && shift ;;
    --seconds) seconds=$2 && shift 2 ;;
    --check)
      missing=$(missing_parts | paste -sd, -)
      [[ -z $missing ]] && exit 0
      echo "not installed: $missing; run scripts/install_dependencies.sh --test"
      exit 1
      ;;
    --) shift && break ;;
    *) echo "vm.sh: unknown option '$1'" >&2 && exit 2 ;;
  esac
done
[[ $# -gt 0 ]] || { echo "usage: vm.sh [--out DIR] [--seconds N] [--skip-idle] -- COMMAND..." >&2 && exit 2; }
out=$(realpath "${out:-$(mktemp -d)}")
mkdir -p "$out" "$cache"
(
  flock 9
  is_ready || prepare
) 9>"$cache/lock"

{
  echo "export PATH=/usr/local/bin:/usr/bin:/usr/sbin:/bin:/sbin HOME=/root"
  # A checkout in /tmp must stay visible.
  [[ $PWD == /tmp/* ]] || echo "mount -t tmpfs tmp /tmp"
  printf 'cd %q || exit 1\n' "$PWD"
  printf '('
  printf ' %q' "$@"
  echo ' ) >/vm-out/output 2>&1; echo $? > /vm-out/.status; sync'
  echo 'echo o > /proc/sysrq-trigger; sleep 60'
} >"$out/.run"
rm -f "$out/.status" "$out/output"
touch "$out/output"
ended=0
boot || ended=$?
cat "$out/output"
if [[ ! -s $out/.status ]]; then
  if [[ $ended == 124 ]]; then
    echo "vm.sh: the command did not finish in $seconds s; the console ended with:" >&2
  else
    echo "vm.sh: the machine ended with status $ended before the command did; its console ended with:" >&2
  fi
  tail -n 25 "$out/console" >&2
  exit 124
fi
exit "$(cat "$out/.status")"
