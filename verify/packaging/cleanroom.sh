#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# cleanroom.sh [OPTION ...] CHECKOUT COMMAND...: runs a command in a copy of a checkout on a bare Debian of this machine's
# release, as a newcomer would, where nothing is installed that the command does not install. To be called as root.
#   --as-user       as an ordinary user without sudo, not as root
#   --room FOLDER   uses this room, and keeps it: what one command installs, the next one finds. Without: a new room,
#                   which is removed afterwards.
#   --archive       the copy is the source archive of HEAD, without .git; else a clone, with what is not committed
#   --folder NAME   of the copy, in the home of the room's user (default: checkout)
#   --offline       without a network
#   COMMAND...      one word: a line for bash; several: a program with its arguments
# Prints what the command prints, also into a log, then its exit code, which is also that of this script. The room is
# mounted in a namespace of its own: nothing stays mounted, and no process of it stays. The command sees the network's
# settings, DELAM_* and OPENBLAS_CORETYPE of the environment, and nothing else of it. DELAM_KEPT is a folder in the room
# that outlives it.
# The bare system is made once (debootstrap, variant minbase), with the mirror, keys, certificates and proxies of this
# machine's own apt, and stays in $CLEANROOM (default /var/tmp/cleanroom), with the packages that rooms have downloaded.
set -euo pipefail

store=${CLEANROOM:-/var/tmp/cleanroom}
user=root
room=
archive=no
folder=checkout
namespaces=(--mount --pid --fork --kill-child)
while [[ ${1:-} == --* ]]; do
    case $1 in
        --as-user) user=newcomer ;;
        --room)
            room=$(realpath -m "${2:?--room needs a folder}")
            shift
            ;;
        --archive) archive=yes ;;
        --folder)
            folder=${2:?--folder needs a name}
            shift
            ;;
        --offline) namespaces+=(--net) ;;
        *)
            printf 'unknown option %s\n' "$1" >&2
            exit 2
            ;;
    esac
    shift
done
if (($# < 2)); then
    sed -n '3,/^set -/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
fi
checkout=$(realpath "$1")
shift
if ((EUID != 0)); then
    printf 'cleanroom.sh: as root only (debootstrap, chroot)\n' >&2
    exit 2
fi
# A room with all packages, a build and its tests takes 9 GB.
mkdir -p "$store/kept"
chmod 1777 "$store/kept"
if (($(df --output=avail -k "$store" | tail -n 1) < 12000000)); then
    printf 'cleanroom.sh: %s has less than 12 GB free (CLEANROOM names another folder)\n' "$store" >&2
    exit 2
fi
# One run at a time makes the bare system and its room.
exec 8>"$store/lock"
flock 8
# A killed run leaves its room; whoever comes next removes it. A room in use is locked.
for left in "$store"/room.*; do
    if [[ -d $left ]] && flock --nonblock "$left" true; then
        rm -rf --one-file-system "$left"
    fi
done
find "$store" -maxdepth 1 -name 'log.*' -mtime +30 -delete
if ! command -v debootstrap >/dev/null; then
    apt-get update -q >/dev/null
    DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends debootstrap >/dev/null
fi

release=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
bare=$store/$release
archives=$store/archives

# sources: "ADDRESS SUITE COMPONENT" of Debian in this machine's own sources, one a line.
sources() {
    apt-get indextargets --format '$(ORIGIN)|$(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
        sed -n 's/^Debian|//p' | sort -u
}

# settle ROOT: gives it this machine's package sources, proxies, keys and certificates.
settle() {
    local root=$1 file
    sources | sed 's/^/deb /' >"$root/etc/apt/sources.list"
    apt-config dump | grep -E '^Acquire::(http|https|ftp|Check|Retries|ForceIP)' >"$root/etc/apt/apt.conf.d/00machine" || true
    for file in trusted.gpg trusted.gpg.d keyrings; do
        if [[ -e /etc/apt/$file ]]; then
            cp -rL --preserve=mode "/etc/apt/$file" "$root/etc/apt/"
        fi
    done
    mkdir -p "$root/usr/local/share/ca-certificates" "$root/etc/ssl/certs"
    if [[ -d /usr/local/share/ca-certificates ]]; then
        cp -rL /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
    fi
    if [[ -f /etc/ssl/certs/ca-certificates.crt ]]; then
        cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    fi
}

if [[ ! -d $bare ]]; then
    mirror=$(sources | awk -v suite="$release" '$2 == suite { print $1; exit }')
    if [[ -z $mirror ]]; then
        apt-get update -q >/dev/null
        mirror=$(sources | awk -v suite="$release" '$2 == suite { print $1; exit }')
    fi
    if [[ -z $mirror ]]; then
        printf 'cleanroom.sh: the package sources of this machine name no archive of Debian for "%s"\n' "$release" >&2
        exit 2
    fi
    printf 'cleanroom.sh: makes the bare system %s, once\n' "$bare"
    mkdir -p "$store"
    rm -rf --one-file-system "$bare.part"
    debootstrap --variant=minbase "$release" "$bare.part" "$mirror" >"$store/debootstrap.log" ||
        { tail "$store/debootstrap.log"; exit 1; }
    settle "$bare.part"
    # A room is thrown away: dpkg need not wait for the disk at each file.
    echo force-unsafe-io >"$bare.part/etc/dpkg/dpkg.cfg.d/cleanroom"
    chroot "$bare.part" useradd --create-home --shell /bin/bash newcomer
    rm -f "$bare.part"/var/cache/apt/archives/*.deb
    mv "$bare.part" "$bare"
fi
mkdir -p "$archives"

own=no
if [[ -z $room ]]; then
    own=yes
    room=$(mktemp -d "$store/room.XXXXXX")
    log=$(mktemp "$store/log.XXXXXX")
else
    log=$(mktemp "$room.log.XXXXXX")
fi
# leave: removes the room, if it is not to be kept.
leave() {
    if [[ $own == yes ]]; then
        rm -rf --one-file-system "$room"
    fi
}
trap leave EXIT
mkdir -p "$room"
exec 9<"$room"
if ! flock --nonblock 9; then
    printf 'cleanroom.sh: another run is in the room %s\n' "$room" >&2
    exit 2
fi
if [[ ! -f $room/.whole ]]; then
    cp -a "$bare/." "$room/"
    touch "$room/.whole"
fi
flock --unlock 8
# Each room has its own folder of packages: apt-get locks it.
mkdir -p "$room/var/cache/apt/archives/partial"
cp -aln "$archives"/*.deb "$room/var/cache/apt/archives/" 2>/dev/null || true
cp -L /etc/resolv.conf /etc/hosts "$room/etc/"

# The checkout may belong to somebody else.
export GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0='*'
# The room gets the checkout as it stands, with what is not committed yet; one that has it already keeps it.
home=/root
if [[ $user != root ]]; then
    home=/home/$user
fi
copy=$room$home/$folder
if [[ ! -d $copy ]]; then
    if [[ $archive == yes ]]; then
        mkdir -p "$copy"
        git -C "$checkout" archive HEAD | tar -x -C "$copy"
    elif [[ ! -e $checkout/.git ]]; then
        tar -c -C "$checkout" --exclude=./build --exclude=./out . | tar -x -C "$copy"
    else
        git clone --quiet --no-hardlinks "$checkout" "$copy"
        git -C "$checkout" diff --binary HEAD | git -C "$copy" apply --allow-empty
        (cd "$checkout" && git ls-files -z --others --exclude-standard | tar --null --files-from=- -c) |
            tar -x -C "$copy"
    fi
    owner=$(chroot "$room" id -u "$user")
    chown -R "$owner:$owner" "$copy"
fi

environment=(HOME="$home" USER="$user" LANG=C.UTF-8 TERM=dumb DELAM_KEPT=/var/tmp/kept PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
while IFS= read -r name; do
    environment+=("$name=${!name}")
done < <(compgen -e | grep -iE '^(https?|ftp|all|no)_proxy$|^(NODE_EXTRA_CA_CERTS|SSL_CERT_FILE|SSL_CERT_DIR|PIP_CERT|GIT_SSL_CAINFO)$|^OPENBLAS_CORETYPE$|^DELAM_[A-Z0-9_]*$' |
    grep -vx DELAM_KEPT)
if (($# > 1)); then
    line=$(printf '%q ' "$@")
else
    line=$1
fi

start=$SECONDS
status=0
mkdir -p "$room/var/tmp/kept"
unshare "${namespaces[@]}" bash -euc '
    room=$1 kept=$2 user=$3 folder=$4 line=$5
    shift 5
    # Ranks of one machine speak over its loopback, also offline.
    ip link set lo up 2>/dev/null || true
    mount -t proc proc "$room/proc"
    # The room has devices of its own: whatever replaces its /dev/null does not harm the machine, and a machine whose
    # /dev/null was replaced does not harm the room.
    mount -t tmpfs -o mode=755,size=16m dev "$room/dev"
    while read -r name major minor; do
        mknod -m 666 "$room/dev/$name" c "$major" "$minor"
    done <<<"null 1 3
zero 1 5
full 1 7
random 1 8
urandom 1 9
tty 5 0"
    mkdir "$room/dev/pts" "$room/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=666,mode=620 devpts "$room/dev/pts"
    ln -s pts/ptmx "$room/dev/ptmx"
    mount -t tmpfs -o mode=1777 shm "$room/dev/shm"
    ln -s /proc/self/fd "$room/dev/fd"
    for name in 0:stdin 1:stdout 2:stderr; do
        ln -s "/proc/self/fd/${name%%:*}" "$room/dev/${name#*:}"
    done
    if ! chroot --userspec=newcomer "$room" bash -c ": >/dev/null"; then
        echo "cleanroom.sh: an ordinary user cannot write to /dev/null in the room: $(ls -l "$room/dev/null")"
        exit 2
    fi
    mount --rbind -o ro /sys "$room/sys"
    mount --bind "$kept" "$room/var/tmp/kept"
    exec chroot --userspec="$user" "$room" env -i "$@" \
        bash -c "cd ~/$(printf %q "$folder") || exit; $line"
' cleanroom "$room" "$store/kept" "$user" "$folder" "$line" "${environment[@]}" </dev/null 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
# The next room finds the packages that this one has downloaded.
cp -aln "$room"/var/cache/apt/archives/*.deb "$archives/" 2>/dev/null || true
printf 'cleanroom.sh: exit code %d after %d s; log %s\n' "$status" "$((SECONDS - start))" "$log"
exit "$status"
