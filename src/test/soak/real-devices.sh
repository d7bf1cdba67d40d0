#!/usr/bin/env bash
# Runs 200 devices with an MQTT client and their credentials beside Mosquitto, some faulty; kills IoT Agent, control plane and broker.
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
Starts Mosquitto, a process with stand-ins for Orion and the IoT Agent, and ./furrow up --no-simulated-devices.
Ten missions have 200 devices with periods of 1 s to 15 min. Each device is a program in Python with an MQTT client and its row of the
credentials. 20 devices use their own attribute names, 10 have no GPS, 5 a wrong password, 5 a wrong topic, 5 send invalid JSON, 5 have a
wrong clock, one is a faulty thermometer, ten move and eight of them meet. Devices with a period of 30 s or more begin with twelve stored
measures, which replaces hours of waiting.
Each report must be in its mission once. Averages and encounters must equal those computed by definition from the reports that the
programs recorded. ./furrow device show must name each fault, commands must be answered, and rotated logins must be rejected within 2 s.
Then IoT Agent, up and Mosquitto are killed (kill -9) in turn: all devices must reconnect with the same login, without a rejection, and
report. Finally the faulty devices connect to the suite's own broker and agent, which detect more faults.
Needs Mosquitto (the Debian package mosquitto), Python 3 with paho-mqtt and some 3 GB of memory.

  --seconds N  Duration of each undisturbed phase, one before and one after the kills. Default: $seconds.
USAGE
}

read_options "seconds" "$@"
check_numbers 10 seconds
for program in mosquitto_passwd python3; do
    command -v "$program" >/dev/null || fail "$program is missing. Install the Debian packages mosquitto and python3."
done
python3 -c 'import paho.mqtt' 2>/dev/null || fail "Python has no paho-mqtt, the MQTT client of the devices. Install it: python3 -m pip install paho-mqtt"

prepare_source
run_program devices.RealDevices "$home" "$logs/farm" "$seconds" || fail "The faults are listed above; logs of all processes: $logs/farm"
echo "real-devices: passed"
