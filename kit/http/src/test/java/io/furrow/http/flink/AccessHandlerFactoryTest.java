package io.furrow.http.flink;

import java.util.Map;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.util.ConfigurationException;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AccessHandlerFactoryTest {
    @ParameterizedTest
    @CsvSource({
        "furrow.http.allowed-hosts, flink.farm;http://farm, '''http://farm'' is not a host'",
        "furrow.http.allowed-origins, *, '''*'' is not an origin'"
    })
    void namesTheInvalidOption(String option, String value, String reason) {
        Configuration configuration = new Configuration();
        configuration.setString(option, value);

        assertThatThrownBy(() -> new AccessHandlerFactory().createHandler(configuration, Map.of()))
                .isInstanceOf(ConfigurationException.class)
                .hasMessageStartingWith(option + ": ")
                .hasMessageContaining(reason);
    }
}
