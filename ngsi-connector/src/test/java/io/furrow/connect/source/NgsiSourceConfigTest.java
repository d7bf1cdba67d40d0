package io.furrow.connect.source;

import java.net.URI;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.connect.source.option.JournalOptions;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class NgsiSourceConfigTest {
    @Test
    void needsNoOptionButTheFolderOfItsJournal() {
        NgsiSourceConfig config = config(Map.of());

        assertThat(config.listening().host()).isEqualTo("127.0.0.1");
        assertThat(config.listening().port()).isEqualTo(8090);
        assertThat(config.topics().topic()).isEqualTo("data.raw");
        assertThat(config.topics().deadLetterTopic()).isEqualTo("data.raw.dead");
        assertThat(config.translation().excluded())
                .extracting(Object::toString)
                .containsExactly("Analytics:.*", "Domain", "Mission");
    }

    @Test
    void derivesTheLargestRecordFromTheProducerAndTheTopic() {
        String producer = "producer.override.max.request.size";
        String topic = "topic.creation.default.max.message.bytes";
        int ofKafka = 1024 * 1024 - 16 * 1024;
        int large = 16777216 - 16 * 1024;

        assertThat(maxRecordBytes(Map.of())).isEqualTo(ofKafka);
        assertThat(maxRecordBytes(Map.of(producer, "16777216"))).isEqualTo(ofKafka);
        assertThat(maxRecordBytes(Map.of(topic, "16777216"))).isEqualTo(ofKafka);
        assertThat(maxRecordBytes(Map.of(producer, "16777216", topic, "16777216")))
                .isEqualTo(large);
        assertThat(maxRecordBytes(Map.of(producer, "16777216", "admin.override.bootstrap.servers", "127.0.0.1:9092")))
                .isEqualTo(large);
        assertThat(maxRecordBytes(Map.of("max.record.bytes", "500000"))).isEqualTo(500_000);
    }

    private static int maxRecordBytes(Map<String, String> options) {
        return config(options).sizes().maxRecordBytes();
    }

    @Test
    void keepsWhatItKnowsOfOneContextBrokerApartFromAnother() {
        JournalOptions journal = config(Map.of()).journal();

        Path one = journal.repairFolder("ngsi", URI.create("http://one:1026"));

        assertThat(journal.repairFolder("ngsi", URI.create("http://one:1026"))).isEqualTo(one);
        assertThat(journal.repairFolder("ngsi", URI.create("http://two:1026"))).isNotEqualTo(one);
        assertThat(journal.repairFolder("other", URI.create("http://one:1026"))).isNotEqualTo(one);
    }

    @ParameterizedTest
    @CsvSource({
        "listen.port, 70000", "listen.host, ''", "topic, data raw",
        "dead.letter.topic, a/b", "dead.letter.topic, data.raw", "exclude.types, 'A,(B'",
        "max.clock.skew.ms, 3600000", "max.body.bytes, 0", "max.record.bytes, 1000",
        "journal.dir, relative/folder", "journal.max.bytes, 1000", "journal.min.free.bytes, -1",
        "max.pending.bytes, 1000", "overload.answer, 429", "overload.hold.ms, 0",
        "overload.memory.bytes, 1000", "listen.request.timeout.ms, 4000", "listen.max.connections, 0",
        "secret.header, 'a b'", "secret.previous, old", "secret.file, /nowhere/secret",
        "ssl.client.auth, required", "ssl.client.auth, sometimes", "ssl.truststore.location, /a",
        "ssl.keystore.password, unused", "batch.size, 0"
    })
    void namesTheOptionThatCannotBeUsed(String option, String value) {
        assertThatThrownBy(() -> config(Map.of(option, value)))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining(option);
    }

    @Test
    void refusesABodyThatTheJournalNeverHasRoomFor() {
        Map<String, String> large =
                Map.of("max.body.bytes", "30000000", "max.pending.bytes", "30000000", "journal.max.bytes", "67108864");

        assertThatThrownBy(() -> config(large))
                .isInstanceOf(ConfigException.class)
                .hasMessageContainingAll("max.body.bytes", "journal.max.bytes");
        assertThat(config(Map.of("journal.max.bytes", "67108864")).sizes().maxBodyBytes())
                .isEqualTo(8 * 1024 * 1024);
    }

    @Test
    void wantsAFolderForTheJournal() {
        assertThatThrownBy(() -> new NgsiSourceConfig(Map.of()))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("journal.dir");
    }

    @Test
    void givesEachTaskItsPort() {
        Map<String, String> second = Map.of("listen.port", "9000", "task.index", "1", "task.count", "3");
        assertThat(config(second).listening().port()).isEqualTo(9001);
        assertThat(config(Map.of("listen.port", "0", "task.index", "1"))
                        .listening()
                        .port())
                .isZero();
        assertThatThrownBy(() -> config(Map.of("listen.port", "65534", "tasks.max", "3")))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("listen.port");
    }

    private static NgsiSourceConfig config(Map<String, String> options) {
        Map<String, String> all = new HashMap<>(Map.of("journal.dir", "/tmp/journal"));
        all.putAll(options);
        return new NgsiSourceConfig(all);
    }

    @Test
    void documentsEveryOption() {
        assertThat(NgsiSourceConfig.definition().configKeys().values()).allSatisfy(option -> {
            assertThat(option.documentation).endsWith(".").hasSizeGreaterThan(20);
            assertThat(option.group).isNotBlank();
            assertThat(option.validator).as(option.name).isNotNull();
        });
    }
}
