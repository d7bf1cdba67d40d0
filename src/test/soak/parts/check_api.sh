#!/usr/bin/env bash
# Checks the description of the API at FURROW_API, and its answers against it. Arguments: configuration, examples, seed.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" # where Schemathesis keeps what it has found
curl -fsS "$FURROW_API/openapi.json" >openapi.json
openapi-spec-validator openapi.json
SCHEMATHESIS_HOOKS=${1%.toml}_hooks.py schemathesis --config-file "$1" run "$FURROW_API/openapi.json" --phases examples,coverage,fuzzing --max-examples "$2" --seed "$3" --no-color
