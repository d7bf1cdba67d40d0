#!/usr/bin/env bash
# Kills and cuts off the control plane and all it speaks with under random requests; then desired and actual must agree.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

minutes=60
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak control-chaos [OPTION VALUE]…
Runs two control planes as processes, with Kafka as a process, Mosquitto, stand-ins for the context broker and the IoT Agent, a
webhook and a host of simulated devices. Random requests go over REST and over Kafka; a request that is not answered is
sent again under its id. Meanwhile both control planes, Kafka and Mosquitto are killed (kill -9) and started again at
random moments, and context broker, IoT Agent and webhook refuse connections, hang or answer 503. Once everything is back,
each request must have one answer; missions, devices at the IoT Agent and MQTT accounts must be as asked for; all parts must be
up; each alarm must have been raised once, listed, and taken by the webhook in its last state.
Needs Mosquitto (the Debian package mosquitto) and some 3 GB of memory.

  --minutes N  How long requests are sent and parts fail. Default: $minutes.
  --seed N     Of all random choices. Default: another each time; it is printed.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --minutes) minutes=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "control-chaos knows no option $1. See: ./furrow soak control-chaos --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak control-chaos --help"
    shift 2
done
[[ $minutes =~ ^[1-9][0-9]{0,4}$ ]] || fail "--minutes must be a whole number from 1, not '$minutes'."
[[ $seed =~ ^[0-9]{1,18}$ ]] || fail "--seed must be a whole number, not '$seed'."

prepare_source control-chaos
suite=$home/suite/launcher/target
lib=$suite/furrow/lib
"$java" -Xmx768m -Dfurrow.log="$logs/driver.log" -cp "$home/src/target/test-classes:$lib/*:$suite/furrow/lib-last/*" \
    io.furrow.soak.control.ControlChaos "$logs/farm" "$minutes" "$seed" \
    > >(while IFS= read -r line; do say "$line"; done) 2>>"$logs/driver.out" &
own $!
wait $! || fail "What was asked for and what there is differ, as said above; seed $seed. Logs of all parts: $logs/farm"
echo "control-chaos: passed"
