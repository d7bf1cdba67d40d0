package io.furrow.cli.control;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class DomainCommandGroupTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            {"missionCount":3,"stopped":["m"],"fieldCount":7} | Delete domain d with 3 missions, of which 1 runs, and end 7 fields?
            {"missionCount":1,"stopped":[],"fieldCount":0}    | Delete domain d with 1 mission, and end 0 fields?
            """)
    void asksWithWhatADomainIsDeleted(String answer, String question) throws Exception {
        assertThat(DomainCommandGroup.question("d", NgsiJson.mapper().readTree(answer)))
                .isEqualTo(question);
    }
}
