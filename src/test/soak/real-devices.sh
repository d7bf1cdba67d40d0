#!/usr/bin/env bash
# 200 devices with nothing but an MQTT client and their credentials beside a real Mosquitto, some faulty; agent, control plane and broker are killed.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

seconds=50

usage() {
    cat <<USAGE
Usage: ./furrow soak real-devices [OPTION VALUE]…
Runs Mosquitto, stand-ins of Orion and IoT Agent in a process of their own, and ./furrow up --no-simulated-devices beside them.
Ten missions have 200 devices with periods of 1 s to 15 min; each is a program in Python with an MQTT client and its row of the
credentials. 20 have names of their own for what they send, 10 no GPS; 5 have a wrong password, 5 a wrong topic, 5 send broken
JSON, 5 have a wrong clock, one is a broken thermometer, ten drive and eight of them meet. Those that report every 30 s or less
often begin with twelve stored measures, so that hours of theirs need not be waited for.
All must be in their missions, each report once; averages and encounters are compared with what their definitions make of what the
programs say they sent; ./furrow device show must name each fault; commands are answered, and rotated logins cut off within 2 s.
Then agent, up, and Mosquitto are killed (kill -9) in turn: all must be connected with the login that they had, without having been
refused, and report. Last, the faulty devices meet the suite's own broker and agent, which know of more faults.
Needs Mosquitto (the Debian package mosquitto), Python 3 with paho-mqtt and some 3 GB of memory.

  --seconds N  How long nothing is disturbed, once before and once after the kills. Default: $seconds.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        *) fail "real-devices knows no option $1. See: ./furrow soak real-devices --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak real-devices --help"
    shift 2
done
[[ $seconds =~ ^[1-9][0-9]{1,3}$ ]] || fail "--seconds must be a whole number from 10, not '$seconds'."
for program in mosquitto_passwd python3; do
    command -v "$program" >/dev/null || fail "No $program found. Install the Debian packages mosquitto and python3."
done
python3 -c 'import paho.mqtt' 2>/dev/null || fail "Python has no paho-mqtt, the MQTT client of the devices. Install it: python3 -m pip install paho-mqtt"

prepare_source real-devices
suite=$home/suite/launcher/target/furrow
"$java" -Xmx768m -Dfurrow.log="$logs/driver.log" -cp "$home/src/target/test-classes:$suite/lib/*:$suite/lib-last/*" \
    io.furrow.soak.devices.RealDevices "$home" "$logs/farm" "$seconds" \
    > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/driver.out" &
own $!
wait $! || fail "Something differs from what must hold, as said above. Logs of all parts: $logs/farm"
echo "real-devices: passed"
