package io.furrow.connect;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import org.apache.kafka.common.config.ConfigDef.ConfigKey;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.ValidString;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.ConfigValue;
import org.apache.kafka.connect.connector.Connector;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.connect.sink.NgsiSinkConnector;
import io.furrow.connect.source.NgsiSourceConnector;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class OptionsTest {
    static Stream<ConfigKey> options() {
        return Stream.of(new NgsiSourceConnector(), new NgsiSinkConnector())
                .flatMap(connector -> connector.config().configKeys().values().stream())
                .filter(key -> !key.internalConfig);
    }

    @ParameterizedTest
    @MethodSource("options")
    void haveADocumentationAGroupAPlaceANameAndAValidator(ConfigKey option) {
        assertThat(option.documentation).as(option.name).endsWith(".").hasSizeGreaterThan(20);
        assertThat(option.group).as(option.name).isNotBlank();
        assertThat(option.orderInGroup).as(option.name).isPositive();
        assertThat(option.displayName).as(option.name).isNotEqualTo(option.name);
        assertThat(option.validator).as(option.name).isNotNull();
        assertThat(option.validator.toString()).as(option.name).doesNotContain("@");
    }

    @ParameterizedTest
    @MethodSource("options")
    void offerTheirValuesWhereThereAreFew(ConfigKey option) {
        if (option.validator instanceof ValidString) {
            assertThat(option.recommender).as(option.name).isNotNull();
            List<Object> offered = option.recommender.validValues(option.name, Map.of());
            assertThat(offered).as(option.name).hasSizeGreaterThan(1);
            offered.forEach(value -> option.validator.ensureValid(option.name, value));
        }
    }

    @ParameterizedTest
    @MethodSource("options")
    void keepSecretsThatTheirNamesSpeakOf(ConfigKey option) {
        if (option.name.matches(".*(password|secret|token)s?")) {
            assertThat(option.type).as(option.name).isEqualTo(Type.PASSWORD);
        }
    }

    @ParameterizedTest
    @CsvSource({
        "sink, retry.backoff.max.ms, 10",
        "sink, batch.size, none",
        "sink, context.broker.ssl.truststore.location, /nowhere",
        "source, listen.request.timeout.ms, 1000",
        "source, ssl.client.auth, required",
        "source, listen.port, 65536",
        "source, exclude.types, ("
    })
    void areNamedWhereTheyAreWrongAlsoTogetherWithOthers(String side, String option, String value) {
        Connector connector = side.equals("sink") ? new NgsiSinkConnector() : new NgsiSourceConnector();
        Map<String, String> options =
                new HashMap<>(Map.of("name", "n", "context.broker.url", "https://orion:1026", "journal.dir", "/tmp"));
        options.put(option, value);

        List<ConfigValue> wrong = connector.validate(options).configValues().stream()
                .filter(each -> !each.errorMessages().isEmpty())
                .toList();

        assertThat(wrong).extracting(ConfigValue::name).containsExactly(option);
    }

    @Test
    void letAFailureThroughThatNamesNoOption() {
        Connector connector = new NgsiSinkConnector();
        var each = connector.validate(Map.of("context.broker.url", "http://orion:1026"));

        assertThatThrownBy(() -> CrossFieldValidator.with(each, () -> {
                    throw new ConfigException("odd");
                }))
                .hasMessage("odd");
    }
}
