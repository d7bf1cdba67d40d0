package io.furrow.http.connect;

import java.util.Map;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AccessExtensionTest {
    @ParameterizedTest
    @CsvSource({
        "furrow.http.allowed.hosts, 'connect.farm,http://farm', '''http://farm'' is not a host'",
        "furrow.http.allowed.origins, *, '''*'' is not an origin'"
    })
    void namesTheInvalidOption(String option, String value, String reason) {
        try (AccessExtension extension = new AccessExtension()) {
            assertThatThrownBy(() -> extension.configure(Map.of(option, value)))
                    .isInstanceOf(ConfigException.class)
                    .hasMessageStartingWith(option + ": ")
                    .hasMessageContaining(reason);
        }
    }
}
