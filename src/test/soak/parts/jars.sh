# Fetches libraries with Maven. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home, run, logs come from the soak

# fetch_jars FOLDER GROUP:ARTIFACT:VERSION…: fetches libraries with what they need, unless they are there.
fetch_jars() {
    local folder=$1 coordinates group artifact version
    shift
    [[ ! -f $folder/complete ]] || return 0
    say "fetching $*"
    {
        echo '<project xmlns="http://maven.apache.org/POM/4.0.0"><modelVersion>4.0.0</modelVersion>'
        echo '<groupId>io.furrow</groupId><artifactId>soak</artifactId><version>1</version><packaging>pom</packaging><dependencies>'
        for coordinates in "$@"; do
            IFS=: read -r group artifact version <<<"$coordinates"
            echo "<dependency><groupId>$group</groupId><artifactId>$artifact</artifactId><version>$version</version></dependency>"
        done
        echo '</dependencies></project>'
    } >"$run/pom.xml"
    (cd "$home" && ./mvnw -B -ntp -q -f "$run/pom.xml" org.apache.maven.plugins:maven-dependency-plugin:3.8.1:copy-dependencies \
        -DincludeScope=runtime -DoutputDirectory="$folder") >"$logs/fetch.log" 2>&1 || fail "Cannot fetch $*: $logs/fetch.log"
    touch "$folder/complete"
}
