#!/usr/bin/env bash
# The page in a real browser: from Kafka to the pixel, its heap and its frames with 1,000 devices, a hidden tab; and the pictures of the documentation.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

events=300
devices=1000
minutes=5
seconds=20
turns=5
pictures=
only=

usage() {
    cat <<USAGE
Usage: ./furrow soak page [OPTION VALUE]…
Starts a suite with the demonstration farm and opens its dashboard in the machine's Chromium, once for each check:
delay   an event in Kafka is a pixel on the map, and a number on the card, within 500 ms (p95)
heap    the page's heap after collection in the last minute is at most 1.1 of that in the first, devices moving at 1 Hz
hidden  a hidden page costs the suite at most 2 % of a core
frames  the main thread takes at most twice as long for a frame of the map, alone and with cards in view, as for one of a bare page of OpenLayers
        with the same points; no suite runs
Needs the Debian packages chromium and fonts-dejavu-core.

  --only NAME      One of delay, heap, hidden and frames.
  --events N       Of delay. Default: $events.
  --devices N      Of heap and frames. Default: $devices.
  --minutes N      Of heap. Default: $minutes.
  --seconds N      Of each turn of hidden and frames. Default: $seconds.
  --turns N        Of frames. Default: $turns.
  --pictures DIR   No check, but pictures of the main views into this folder, as in docs/images.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --only) only=${2-} ;;
        --events) events=${2-} ;;
        --devices) devices=${2-} ;;
        --minutes) minutes=${2-} ;;
        --seconds) seconds=${2-} ;;
        --turns) turns=${2-} ;;
        --pictures) pictures=${2-} ;;
        *) fail "page knows no option $1. See: ./furrow soak page --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak page --help"
    shift 2
done
for number in "$events" "$devices" "$minutes" "$seconds" "$turns"; do
    [[ $number =~ ^[1-9][0-9]{0,4}$ ]] || fail "--events, --devices, --minutes, --seconds and --turns are whole numbers from 1, not '$number'."
done
[[ -z $only || $only =~ ^(delay|heap|hidden|frames)$ ]] || fail "--only is one of delay, heap, hidden and frames, not '$only'."
command -v chromium >/dev/null 2>&1 || fail "There is no chromium. Install it: apt-get install chromium fonts-dejavu-core"
[[ -z $pictures ]] || { mkdir -p "$pictures" && pictures=$(cd "$pictures" && pwd); }

prepare_source page
suite=$home/suite/launcher/target
browser_path

check() {
    say "$*"
    # shellcheck disable=SC2046 # options of the JVM, one a word
    "$java" -Xmx1536m $(sed -n 's:.*<flink.jvm.args>\(.*\)</flink.jvm.args>.*:\1:p' "$home/pom.xml") \
        -Dfurrow.plugins="$suite/furrow/plugins" -cp "$home/src/target/test-classes:$suite/furrow/lib/*:$(<"$run/path"):$suite/furrow/lib-last/*" \
        io.furrow.suite.page.PageSoak "$@" > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/$1.out" &
    own $!
    wait $! || fail "page: $1 failed, as said above."
}

if [[ -n $pictures ]]; then
    check pictures "$pictures"
    exit 0
fi
[[ -n $only && $only != delay ]] || check delay "$events"
[[ -n $only && $only != heap ]] || check heap "$devices" "$minutes"
[[ -n $only && $only != hidden ]] || check hidden "$seconds"
[[ -n $only && $only != frames ]] || check frames "$devices" "$turns" "$seconds"
echo "page: passed"
