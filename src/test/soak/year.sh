#!/usr/bin/env bash
# A farm's year in some 90 minutes, a day in ten seconds: missions and fields come and go, each week ends with a restart, a kill -9 or a power cut.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

weeks=52
day=10

usage() {
    cat <<USAGE
Usage: ./furrow soak year [OPTION VALUE]…
Runs Mosquitto, stand-ins of Orion and IoT Agent in a process of their own, and ./furrow up beside them. Each day three missions of ten
devices begin, report once a second, and end. All year one device has a clock that is two hours slow, and one names a new mission with each
report. Fields move, get other names and end; a mission of each week has a device that falls silent and one that never reports; another is
played back. In the middle of the last day of a week the suite is restarted or killed; at the end of each fourth week the machine loses power:
of half of Kafka's partitions an earlier state is put back that was not synced yet.
After each week every report that was answered 2xx must be on data.raw, on its mission's topic (once, unless something was killed; those of the last
second before a power cut may be missing there and are counted), and once in MongoDB; encounters and averages must be those that their
definitions make of the reports (but for windows around a power cut, which are counted); the fields must be those that were asked for; the alarms
silent-device and missing-devices must be there while their mission runs, over the restart too, and not afterwards; the replay must have each event
once. In the fourth week and the last the page must show all devices within 3 s. At the end data.raw must have lost its oldest records to its
retention, topics, partitions, collections, alarms, files, threads and heap after collection are at most 1.2 times those of the fourth week, and the
start takes at most 1.5 times as long.
By options of ./furrow up are scaled the windows of averages (--window 2s) and the time that devices of a mission may take (--start-timeout 5s), by
the period of its devices when one is silent (PT1S), by settings of its topics the retention of data (1.75 times what the first week took). For these
./furrow up has no option, and the soak does it in its place: missions are deleted after a week, with topic (after a day) and collection
(--mission-retention of ingest); topics of a replay when it was deleted (--replay-grace, an hour). Not scaled is when a device that never reported
counts as silent, two minutes, more than there is between two restarts: missing-devices names it.
Needs the Debian packages mosquitto, chromium and fonts-dejavu-core, and some 3 GB of memory.

  --weeks N  How many weeks. Default: $weeks.
  --day N    Seconds of a day, 5 at least. Default: $day.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --weeks) weeks=${2-} ;;
        --day) day=${2-} ;;
        *) fail "year knows no option $1. See: ./furrow soak year --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak year --help"
    shift 2
done
[[ $weeks =~ ^[1-9][0-9]{0,2}$ ]] || fail "--weeks must be a whole number from 1, not '$weeks'."
[[ $day =~ ^([5-9]|[1-9][0-9]{1,2})$ ]] || fail "--day must be a whole number from 5 to 999, not '$day'."
command -v chromium >/dev/null 2>&1 || fail "There is no chromium. Install it: apt-get install chromium fonts-dejavu-core"
command -v mosquitto_passwd >/dev/null || fail "No mosquitto_passwd found. Install the Debian package mosquitto."

prepare_source year
suite=$home/suite/launcher/target/furrow
browser_path
"$java" -Xmx768m -Dfurrow.log="$logs/driver.log" -cp "$home/src/target/test-classes:$suite/lib/*:$(<"$run/path"):$suite/lib-last/*" \
    io.furrow.soak.year.FarmYear "$home" "$logs/farm" "$weeks" "$day" \
    > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/driver.out" &
own $!
wait $! || fail "Something differs from what must hold, as said above. Logs of all parts: $logs/farm"
echo "year: passed"
