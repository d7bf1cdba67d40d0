#!/usr/bin/env bash
# Simulates a farm's year in some 90 minutes, ten seconds per day; each week ends with a restart, a kill -9 or a power cut.
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
Starts Mosquitto, a process with stand-ins for Orion and the IoT Agent, and ./furrow up. Each day three missions of ten devices start, report
once per second, and end. All year, the clock of one device is two hours slow, and another device names a new mission in each report. Fields
are moved, renamed and ended. One mission per week has a device that becomes silent and one that never reports, another mission is replayed.
In the middle of the last day of a week the suite is restarted or killed. At the end of every fourth week a power cut is simulated: half of
Kafka's partitions are reset to an earlier state, as if later records had not been synced.

After each week:
- every report answered 2xx is on data.raw, on its mission's topic (once unless a process was killed; reports of the last second before a
  power cut may be missing there and are counted), and once in MongoDB;
- encounters and averages are those computed by definition from the reports, except windows around a power cut, which are counted;
- the fields are as requested;
- the alarms silent-device and missing-devices are open while their mission runs, also after the restart, and closed afterwards;
- the replay has each event once.
In the fourth and the last week the page shows all devices within 3 s. At the end, data.raw has lost its oldest records to its retention;
topics, partitions, collections, alarms, files, threads and heap after a collection are at most 1.2 times those of the fourth week, and a
start takes at most 1.5 times as long.

Scaled by options of ./furrow up: the windows of averages (--window 2s) and the start of missions (--start-timeout 5s). Scaled by the period
of the devices: the time until a device is silent (PT1S). Scaled by topic settings: the retention of data (1.75 times the duration of the
first week). The soak itself deletes what ./furrow up deletes too late: missions after a week, with their topic (after a day) and collection
(--mission-retention of ingest), and the topics of a deleted replay (--replay-grace, an hour). Not scaled: a device that never reported is
silent after two minutes, longer than the time between two restarts, therefore only missing-devices names it.
Needs the Debian packages mosquitto, chromium and fonts-dejavu-core, and some 3 GB of memory.

  --weeks N  Weeks. Default: $weeks.
  --day N    Seconds per day, at least 5. Default: $day.
USAGE
}

read_options "weeks day" "$@"
check_numbers 1 weeks
check_numbers 5 day
command -v chromium >/dev/null 2>&1 || fail "chromium is missing. Install it: apt-get install chromium fonts-dejavu-core"
command -v mosquitto_passwd >/dev/null || fail "mosquitto_passwd is missing. Install the Debian package mosquitto."

prepare_source
browser_path
run_program year.FarmYear "$home" "$logs/farm" "$weeks" "$day" || fail "The faults are listed above; logs of all processes: $logs/farm"
echo "year: passed"
