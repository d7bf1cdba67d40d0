package io.furrow.connect.sink;

import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class NgsiSinkConfigTest {
    @Test
    void needsTheContextBrokerOnly() {
        NgsiSinkConfig config = new NgsiSinkConfig(Map.of("context.broker.url", "http://orion:1026"));

        assertThat(config.broker().url()).hasToString("Optional[http://orion:1026]");
        assertThat(config.entities().scope()).isEqualTo(FiwareScope.DEFAULT);
        assertThatThrownBy(() -> new NgsiSinkConfig(Map.of()))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("context.broker.url");
    }

    @ParameterizedTest
    @CsvSource({
        "context.broker.url, orion:1026", "context.broker.url, ftp://orion", "context.broker.url, http://a b",
        "context.broker.url, http://orion/?x=1", "fiware.service, Agri!", "fiware.servicepath, plot1",
        "batch.size, 0", "batch.bytes, -1", "context.broker.timeout.ms, never",
        "retry.backoff.ms, 0", "retry.backoff.max.ms, 10", "api, ngsi-v1",
        "ngsi.ld.context, context.jsonld", "time.metadata, a b", "entity.type, a b",
        "delete.on.null, maybe", "echo.sources, (", "parallel.requests, 0",
        "known.attributes.max, -1", "known.max.age.ms, -1", "retry.isolate.after, -1",
        "retry.refuse.after, -1", "context.broker.ssl.truststore.location, /nowhere"
    })
    void namesTheOptionThatCannotBeUsed(String option, String value) {
        Map<String, String> options = new HashMap<>(Map.of("context.broker.url", "http://orion:1026"));
        options.put(option, value);

        assertThatThrownBy(() -> new NgsiSinkConfig(options))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining(option);
    }

    @Test
    void documentsEveryOption() {
        assertThat(NgsiSinkConfig.definition().configKeys().values()).allSatisfy(option -> {
            assertThat(option.documentation).endsWith(".").hasSizeGreaterThan(20);
            assertThat(option.group).isNotBlank();
            assertThat(option.validator).as(option.name).isNotNull();
        });
    }
}
