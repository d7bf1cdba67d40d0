#!/usr/bin/env bash
# Kills and disconnects the control plane and its servers under random requests; then desired and actual state must agree.
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
Starts two control planes, Kafka and Mosquitto as processes, stand-ins for the context broker and the IoT Agent, a webhook and a host of
simulated devices. Sends random requests over REST and Kafka, and retries an unanswered request with the same id. Meanwhile both control
planes, Kafka and Mosquitto are killed (kill -9) and restarted at random moments, and context broker, IoT Agent and webhook refuse
connections, hang or answer 503. When all of them are back, each request must have one answer, missions, devices at the IoT Agent and
MQTT accounts must be as requested, all parts must be up, and each alarm must have been raised once, be listed, and have been sent to the
webhook in its last state.
Needs Mosquitto (the Debian package mosquitto) and some 3 GB of memory.

  --minutes N  Duration of requests and failures. Default: $minutes.
  --seed N     Seed of all random choices. Default: random; it is printed.
USAGE
}

read_options "minutes seed" "$@"
check_numbers 1 minutes
check_numbers 0 seed

prepare_source
run_program control.ControlChaos "$logs/farm" "$minutes" "$seed" || fail "The faults are listed above; seed $seed; logs of all processes: $logs/farm"
echo "control-chaos: passed"
