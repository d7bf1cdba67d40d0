#!/usr/bin/env bash
# Sends generated requests to all operations of the REST API with Schemathesis: each answer is as the description has it, none is 500.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

version=4.32.5
examples=50
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak api [OPTION VALUE]…
Starts a control plane as a process beside Kafka, MongoDB and stand-ins of the FIWARE servers, and sends the requests that its
description has as examples; each must be accepted. openapi-spec-validator checks the description. Then Schemathesis sends the
examples, each boundary of each schema, and random requests: no answer may be 500, have a status, media type or body that is not
described, or accept what the description forbids. parts/schemathesis.toml says what is left out, and why. Fetches both from PyPI.

  --version V   Version of Schemathesis. Default: $version.
  --examples N  Random requests per operation. Default: $examples.
  --seed N      Seed of the random requests. Default: random; it is printed.
USAGE
}

read_options "version examples seed" "$@"
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "--version must be like $version, not '$version'."
check_numbers 1 examples
check_numbers 0 seed
python3 -m venv --help >/dev/null 2>&1 || fail "Python 3 with venv is missing, which runs Schemathesis. Install python3-venv."

prepare_source
say "fetching schemathesis $version"
python3 -m venv "$run/python"
"$run/python/bin/pip" -q install --disable-pip-version-check "schemathesis==$version" openapi-spec-validator \
    >"$logs/pip.log" 2>&1 || fail "Cannot fetch schemathesis $version: $logs/pip.log"
say "seed $seed"
export PATH="$run/python/bin:$PATH"
run_program control.DescribedApi "$logs/farm" "$soak/parts/check_api.sh" "$soak/parts/schemathesis.toml" "$examples" "$seed" ||
    fail "The differences are listed above; log of the control plane: $logs/farm/control.log"
echo "api: passed"
