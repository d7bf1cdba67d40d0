#!/usr/bin/env bash
# Measures the page in a real browser: delay from Kafka to the pixel, heap and frames with 1,000 devices, a hidden tab, a crowded farm; takes the pictures of the documentation.
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
Starts a suite with the demonstration farm and opens its dashboard in Chromium, once per check:
delay   an event in Kafka is a pixel on the map, and a number on the card, within 500 ms (p95)
heap    with devices moving at 1 Hz, the page's heap after a collection in the last minute is at most 1.1 times that of the first
hidden  a hidden page costs the suite at most 2 % of a core
frames  the main thread takes at most twice as long for a frame of the map, with and without cards in view, as for a frame of a bare
        OpenLayers page with the same points; without a suite
crowd   on two farms with 30 missions, 40 open alarms and devices moving at 1 Hz: the first view is there within 3 s, Stop of the
        selected robot never moves, no layout shift is above 0.02, a frame takes at most twice as long as on the bare page; without a suite
Needs the Debian packages chromium and fonts-dejavu-core.

  --only NAME      One of delay, heap, hidden, frames and crowd.
  --crowd          The same as --only crowd.
  --events N       Events of delay. Default: $events.
  --devices N      Devices of heap, frames and crowd. Default: $devices.
  --minutes N      Duration of heap. Default: $minutes.
  --seconds N      Duration of each turn of hidden and frames. Default: $seconds; of crowd at least 60.
  --turns N        Turns of frames. Default: $turns.
  --pictures DIR   Instead of checks, writes pictures of the main views to this folder, as in docs/images.
USAGE
}

[[ ${1:-} != --crowd ]] || set -- --only crowd "${@:2}"
read_options "only events devices minutes seconds turns pictures" "$@"
check_numbers 1 events devices minutes seconds turns
[[ -z $only ]] || check_choice only delay heap hidden frames crowd
command -v chromium >/dev/null 2>&1 || fail "chromium is missing. Install it: apt-get install chromium fonts-dejavu-core"
[[ -z $pictures ]] || { mkdir -p "$pictures" && pictures=$(cd "$pictures" && pwd); }

prepare_source
suite=$home/suite/launcher/target
browser_path

check() {
    say "$*"
    # shellcheck disable=SC2046 # one word per option of the JVM
    "$java" -Xmx1536m $(sed -n 's:.*<flink.jvm.args>\(.*\)</flink.jvm.args>.*:\1:p' "$home/pom.xml") \
        -Dfurrow.plugins="$suite/furrow/plugins" -cp "$home/src/target/test-classes:$suite/furrow/lib/*:$(<"$run/path"):$suite/furrow/lib-last/*" \
        io.furrow.suite.page.PageSoak "$@" > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/$1.out" &
    own $!
    wait $! || fail "page: $1 failed; the faults are listed above."
}

if [[ -n $pictures ]]; then
    check pictures "$pictures"
    exit 0
fi
[[ -n $only && $only != delay ]] || check delay "$events"
[[ -n $only && $only != heap ]] || check heap "$devices" "$minutes"
[[ -n $only && $only != hidden ]] || check hidden "$seconds"
[[ -n $only && $only != frames ]] || check frames "$devices" "$turns" "$seconds"
[[ -n $only && $only != crowd ]] || check crowd "$devices" "$((seconds > 60 ? seconds : 60))"
echo "page: passed"
