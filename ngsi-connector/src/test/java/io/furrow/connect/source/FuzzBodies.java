package io.furrow.connect.source;

import java.time.Instant;
import java.util.Arrays;
import java.util.List;
import java.util.Map;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.http.NotificationResponse;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.notification.ReceivedNotification;
import io.furrow.connect.source.notification.Translation;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * What a fuzzer throws at the reading of bodies: the first byte picks the form that the sender names, the others are the
 * body. Whatever it is, it becomes records that every later reader can read, and the ledger's sum is right.
 */
public final class FuzzBodies {
    private static final List<String> FORMS = Arrays.asList(
            null, "normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues", "values", "custom");
    private static final Instant NOW = Instant.parse("2026-11-21T02:00:00Z");
    private static final NotificationTranslator.Settings SETTINGS =
            new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal")).translation();

    private FuzzBodies() {}

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() throws UnreadableException {
        fuzzerTestOneInput("\0{\"id\": \"a\", \"t\": {\"value\": 1}}".getBytes(UTF_8));
        fuzzerTestOneInput("\0no JSON".getBytes(UTF_8));
    }

    /** One body; throws whatever is wrong. */
    public static void fuzzerTestOneInput(byte[] input) throws UnreadableException {
        if (input.length == 0) {
            return;
        }
        String form = FORMS.get((input[0] & 0xff) % FORMS.size());
        byte[] body = Arrays.copyOfRange(input, 1, input.length);
        Ledger ledger = new Ledger();
        Translation translation = new NotificationTranslator(SETTINGS, ledger)
                .translate(new ReceivedNotification(body, true, form, FiwareScope.DEFAULT, NOW, "fuzzer /"));
        for (KafkaRecord record : translation.records()) {
            check(record);
        }
        require(NotificationResponse.taken(translation.refusal()).status() >= 200, "there is no answer");
        require(
                ledger.received.sum() == ledger.accepted.sum() + ledger.dead.sum() + ledger.excluded.sum(),
                "the ledger does not add up");
        require(
                ledger.accepted.sum() + ledger.dead.sum()
                        == translation.records().size(),
                "a record is not counted");
    }

    private static void check(KafkaRecord record) throws UnreadableException {
        KafkaRecord kept = JournalRecordCodec.read(JournalRecordCodec.write(record));
        require(Arrays.equals(kept.value(), record.value()), "the value changed in the journal");
        require(java.util.Objects.equals(kept.key(), record.key()), "the key changed in the journal");
        require(kept.headers().equals(record.headers()), "the headers changed in the journal");
        if (record.topic().equals(SETTINGS.topic()) && record.value() != null) {
            Entity entity = Entity.parse(record.value());
            require(entity.id().equals(record.key()), "the key is not the id");
            byte[] again = entity.toBytes();
            require(Arrays.equals(again, record.value()), new String(again, UTF_8));
        }
    }

    private static void require(boolean right, String message) {
        if (!right) {
            throw new IllegalStateException(message);
        }
    }
}
