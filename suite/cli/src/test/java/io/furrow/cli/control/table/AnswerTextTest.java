package io.furrow.cli.control.table;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class AnswerTextTest {
    @Test
    void printsMembersTimesAndListsForPeople() throws Exception {
        String domain = """
                {"domain": "north", "created": 1795687200000, "fields": ["f-1", "f-2"], "none": [],
                 "clock": {"at": 1795687200000, "shows": 1795687200000}}""";

        assertThat(AnswerText.members(NgsiJson.read(domain.getBytes(UTF_8))))
                .containsExactly(
                        "domain       north",
                        "created      2026-11-26T10:00:00Z",
                        "fields       f-1, f-2",
                        "none         -",
                        "clock.at     2026-11-26T10:00:00Z",
                        "clock.shows  2026-11-26T10:00:00Z");
    }
}
