#!/usr/bin/env bash
# Checks the description of the API at FURROW_API, and its answers against it. Arguments: configuration, examples, seed.
set -euo pipefail

description=$(mktemp)
trap 'rm -f "$description"' EXIT
curl -fsS "$FURROW_API/openapi.json" >"$description"
openapi-spec-validator "$description"
SCHEMATHESIS_HOOKS=${1%.toml}_hooks.py schemathesis --config-file "$1" run "$FURROW_API/openapi.json" --phases examples,coverage,fuzzing --max-examples "$2" --seed "$3" --no-color
