package io.furrow.cli.control;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceCommandGroupTest {
    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "3|3", "2.50|2.50", "true|true", "null|null",
                "[1,2]|[1,2]", "{\"a\":1}|{\"a\":1}", "\"3\"|\"3\"", "007|\"007\"",
                "NaN|\"NaN\"", "to the barn|\"to the barn\"", "``|\"\""
            })
    void readsAValueAsWhatItIs(String given, String sent) {
        assertThat(DeviceCommandGroup.valueOf(given)).hasToString(sent);
    }
}
