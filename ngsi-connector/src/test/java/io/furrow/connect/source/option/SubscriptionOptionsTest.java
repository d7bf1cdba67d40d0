package io.furrow.connect.source.option;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.connect.source.NgsiSourceConfig;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class SubscriptionOptionsTest {
    private static final String BROKER = "http://orion:1026";

    @Test
    void wantsNoSubscriptionWithoutAContextBroker() {
        assertThat(config(Map.of()).subscription().enabled()).isFalse();
        assertThat(config(Map.of("context.broker.url", BROKER)).subscription().enabled())
                .isTrue();
        assertThat(config(Map.of("context.broker.url", BROKER, "subscription.enabled", "false"))
                        .subscription()
                        .enabled())
                .isFalse();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "tasks.max=2 subscription.id.pattern=^urn | subscription.id.pattern | set tasks.max=1",
                "tasks.max=37 | tasks.max | 36 tasks at most",
                "listen.host=0.0.0.0 | public.url | listens on all addresses",
                "subscription.types=Probe subscription.type.pattern=^P | subscription.type.pattern | excludes subscription.types",
                "subscription.id.pattern=( | subscription.id.pattern | no regular expression",
                "subscription.tenants=a-b | subscription.tenants | expected tenants",
                "subscription.servicepaths=farm | subscription.servicepaths | expected absolute service paths",
                "subscription.alteration.types=entityGone | subscription.alteration.types | entityCreate, entityChange",
                "subscription.metadata=a;b | subscription.metadata | expected metadata",
                "subscription.metadata=* subscription.attrs.format=keyValues | subscription.metadata | carries no metadata",
                "public.url=orion | public.url | expected empty, http://HOST:PORT/PATH",
            })
    void refusesWhatCannotWorkAndSaysWhy(String options, String option, String words) {
        Map<String, String> given = new HashMap<>(Map.of("context.broker.url", BROKER));
        for (String one : options.split(" ")) {
            given.put(one.split("=", 2)[0], one.split("=", 2)[1]);
        }

        assertThatThrownBy(() -> config(given))
                .isInstanceOf(ConfigException.class)
                .hasMessageContainingAll(option, words);
    }

    @ParameterizedTest
    @CsvSource({
        "'', http://10.0.0.7:8091/v2/notify",
        "https://farm.example/in, https://farm.example/in",
        "http://worker:{port}/, http://worker:8091/"
    })
    void tellsTheContextBrokerTheAddressOfTheTask(String url, String told) {
        assertThat(config(Map.of("public.url", url)).subscription().url("http", "10.0.0.7", 8091))
                .isEqualTo(told);
    }

    @Test
    void asksForTheKindOfAlterationWhereDeletionsAreTold() {
        SubscriptionOptions options = config(Map.of("subscription.alteration.types", "entityChange,entityDelete"))
                .subscription();

        assertThat(options.content().attrs()).containsExactly("*", "dateModified", "alterationType");
        assertThat(options.subject(Optional.of("[0]$")).idPattern()).isEqualTo("[0]$");
        assertThat(options.tenants()).isEqualTo(List.of(""));
    }

    private static NgsiSourceConfig config(Map<String, String> options) {
        Map<String, String> all = new HashMap<>(Map.of("journal.dir", "/tmp/journal"));
        all.putAll(options);
        return new NgsiSourceConfig(all);
    }
}
