#!/usr/bin/env bash
# A farm's year in some 80 minutes, a day in ten seconds: missions come and go, each week ends with a restart, a kill -9 or a power cut.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(dirname "$soak")
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

weeks=52

usage() {
    cat <<USAGE
Usage: ./furrow soak year [OPTION VALUE]…
Runs Mosquitto, stand-ins of Orion and IoT Agent in a process of their own, and ./furrow up beside them. Each day three missions of ten
devices begin, report once a second, and end; they are deleted a week later, with topic and collection, for which the suite itself would
take a day and a retention. All year one device has a clock that is two hours slow, and one
names a new mission with each report. In the middle of the last day of a week the suite is restarted or killed; at the end of each fourth
week the machine loses power: of half of Kafka's partitions an earlier state is put back that was not synced yet. A mission of the week is
played back.
After each week every report that was answered 2xx must be on data.raw, on its mission's topic (once, unless something was killed; those of the last
second before a power cut may be missing there and are counted), and once in MongoDB; encounters must be
those that their definition makes of the reports. At the end topics, partitions, collections, files, threads and heap after collection are at
most 1.2 times those of the fourth week, and the start takes at most 1.5 times as long.
Needs Mosquitto (the Debian package mosquitto) and some 3 GB of memory.

  --weeks N  How many weeks. Default: $weeks.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --weeks) weeks=${2-} ;;
        *) fail "year knows no option $1. See: ./furrow soak year --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak year --help"
    shift 2
done
[[ $weeks =~ ^[1-9][0-9]{0,2}$ ]] || fail "--weeks must be a whole number from 1, not '$weeks'."
command -v mosquitto_passwd >/dev/null || fail "No mosquitto_passwd found. Install the Debian package mosquitto."

prepare_source year
suite=$home/launcher/target/furrow
"$java" -Xmx768m -Dfurrow.log="$logs/driver.log" -cp "$home/system-tests/target/test-classes:$suite/lib/*:$suite/lib-last/*" \
    io.furrow.soak.year.FarmYear "$home" "$logs/farm" "$weeks" 10 \
    > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/driver.out" &
own $!
wait $! || fail "Something differs from what must hold, as said above. Logs of all parts: $logs/farm"
echo "year: passed"
