package io.furrow.connect.source;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.config.types.Password;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalReader;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.Broker;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.journal.JournalRecordLog;
import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class SubscriptionManagerTest {
    @TempDir
    private Path directory;

    @AutoClose
    private final Broker broker = new Broker(FiwareSettings.httpOnly(), "");

    @Test
    void carryTheSecretAndTheHttpsAddressOfTheListener() throws Exception {
        JsonNode target = targetOf(Map.of(
                "secret", "known-to-both",
                "secret.header", "X-Farm",
                "secret.previous", "former",
                "ssl.keystore.location", directory.resolve("keys.p12").toString()));

        assertThat(target.path("url").asText()).isEqualTo("https://127.0.0.1:8091/v2/notify");
        assertThat(target.at("/headers/X-Farm").asText()).isEqualTo("known-to-both");
    }

    @Test
    void carryTheSecretOfAFile() throws Exception {
        Path file = Files.writeString(directory.resolve("secret"), "known-to-both\nformer\n");

        assertThat(targetOf(Map.of("secret.file", file.toString()))
                        .at("/headers/X-Furrow-Secret")
                        .asText())
                .isEqualTo("known-to-both");
        assertThat(config(Map.of("secret.file", file.toString())).security().secrets())
                .extracting(Password::value)
                .containsExactly("known-to-both", "former");
    }

    @Test
    void carryThePublicAddressWhereThereIsOne() throws Exception {
        JsonNode target = targetOf(Map.of(
                "secret", "known-to-both",
                "public.url", "https://farm.example/in",
                "ssl.keystore.location", directory.resolve("keys.p12").toString()));

        assertThat(target.path("url").asText()).isEqualTo("https://farm.example/in");
    }

    @Test
    void areLeftToOthersWhileTheSourceHasNoTask() {
        NgsiSourceConfig config = config(
                Map.of("listen.port", Integer.toString(FreePort.orFree(0)), "subscription.check.interval.ms", "200"));
        SourceRuntime source = SourceRuntime.open(config, journal -> OptionalLong.empty());
        await().until(() -> broker.subscriptions().size() == 1);

        source.detach();
        await().until(() -> {
            removeAll();
            return broker.subscriptions().isEmpty();
        });
        // Longer than the interval; a look that was under way may have made it once more.
        await().during(Duration.ofSeconds(1)).until(() -> {
            boolean none = broker.subscriptions().isEmpty();
            removeAll();
            return none;
        });

        SourceRuntime resumed = SourceRuntime.attach(config).orElseThrow();
        try {
            await().until(() -> broker.subscriptions().size() == 1);
        } finally {
            resumed.close();
        }
    }

    @Test
    void tellAndRepairTheMetadataThatAreDesired() throws Exception {
        create("before");
        NgsiSourceConfig config =
                config(Map.of("subscription.metadata", "TimeInstant,dateModified", "repair.mode", "initial"));
        Ledger ledger = new Ledger();
        try (NotificationRig rig = new NotificationRig();
                Journal journal = Journal.open(
                                Files.createDirectory(directory.resolve("own")), config.journalSettings())
                        .orElseThrow();
                SubscriptionManager own = new SubscriptionManager(config, ledger)) {
            own.start(rig.port(), new JournalRecordLog(journal, ledger));
            await().until(() -> ledger.repaired.sum() == 1);
            create("after");
            await().until(() -> !rig.recordLog.taken.isEmpty());

            try (JournalReader reader = journal.reader(0)) {
                byte[] repaired = reader.read(1, 1 << 20, Duration.ZERO).get(0).payload();
                assertThat(metadata(JournalRecordCodec.read(repaired))).containsExactly("TimeInstant", "dateModified");
            }
            assertThat(metadata(rig.recordLog.taken.remove().get(0))).containsExactly("TimeInstant", "dateModified");
        }
    }

    private void create(String id) {
        broker.send("POST", "/v2/entities", "/", """
                {"id": "%s", "type": "T", "t": {"type": "Number", "value": 1, "metadata": {
                  "accuracy": {"type": "Number", "value": 1},
                  "TimeInstant": {"type": "DateTime", "value": "2026-01-01T00:00:00.000Z"}}}}""".formatted(id));
    }

    private static List<String> metadata(KafkaRecord record) throws UnreadableException {
        List<String> names = new ArrayList<>();
        Entity.parse(record.value()).json().at("/t/metadata").fieldNames().forEachRemaining(names::add);
        return names;
    }

    private void removeAll() {
        broker.subscriptions()
                .forEach(each -> broker.send(
                        "DELETE", "/v2/subscriptions/" + each.path("id").asText(), "/#", ""));
    }

    private JsonNode targetOf(Map<String, String> options) throws IOException {
        NgsiSourceConfig config = config(options);
        Ledger ledger = new Ledger();
        try (Journal journal = Journal.open(Files.createDirectory(directory.resolve("own")), config.journalSettings())
                        .orElseThrow();
                SubscriptionManager own = new SubscriptionManager(config, ledger)) {
            own.start(8091, new JournalRecordLog(journal, ledger));
            await().until(() -> broker.subscriptions().size() == 1);
        }
        return broker.subscriptions().get(0).at("/notification/httpCustom");
    }

    private NgsiSourceConfig config(Map<String, String> options) {
        Map<String, String> all = new HashMap<>(Map.of(
                "name",
                "farm",
                "journal.dir",
                directory.toString(),
                "topic",
                "raw",
                "context.broker.url",
                broker.uri().toString()));
        all.putAll(options);
        return new NgsiSourceConfig(all);
    }
}
