package io.furrow.control.rest.description;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class IsoTimeFilterTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            /api/domains                | [{"domain":"d","created":0}]                   | [{"domain":"d","created":"1970-01-01T00:00:00Z"}]
            /api/missions/{mission}     | {"status":{"since":1},"duration":1}            | {"status":{"since":"1970-01-01T00:00:00.001Z"},"duration":1}
            /api/replays/{replay}       | {"status":{"progress":{"position":5,"rate":5}},"clock":{"at":-1}} | {"status":{"progress":{"position":"1970-01-01T00:00:00.005Z","rate":5}},"clock":{"at":"1969-12-31T23:59:59.999Z"}}
            /api/audit                  | [{"position":7,"time":1000,"about":{"time":7}}] | [{"position":7,"time":"1970-01-01T00:00:01Z","about":{"time":7}}]
            /api/devices/{device}       | {"settings":{"from":7},"from":2000}            | {"settings":{"from":7},"from":"1970-01-01T00:00:02Z"}
            /api/dead-letters/{topic}/{partition}/{offset} | {"time":3000,"value":{"time":7}} | {"time":"1970-01-01T00:00:03Z","value":{"time":7}}
            /api/recordings/{mission}/timeline | {"from":4000,"width":100,"counts":[4000,null]} | {"from":"1970-01-01T00:00:04Z","width":100,"counts":[4000,null]}
            /api/me                     | {"user":"u","created":1}                       | {"user":"u","created":1}
            """)
    void writesTimesAndNothingElse(String path, String answer, String expected) throws Exception {
        MemberNames known =
                ApiDescription.read().operation("GET", path).orElseThrow().answer();

        byte[] written = IsoTimeFilter.withIsoTimes(answer.getBytes(UTF_8), known);

        assertThat(NgsiJson.read(written)).isEqualTo(NgsiJson.read(expected.getBytes(UTF_8)));
    }
}
