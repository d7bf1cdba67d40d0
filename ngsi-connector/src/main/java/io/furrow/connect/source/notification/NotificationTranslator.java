package io.furrow.connect.source.notification;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Consumer;
import java.util.regex.Pattern;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.EntityVersion;
import io.furrow.connect.source.notification.Translation.Refusal;
import io.furrow.connect.source.option.EntityOptions;
import io.furrow.connect.source.option.JournalOptions;
import io.furrow.model.event.ClockFaults;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.EntityRecord;
import io.furrow.model.event.EventTime;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.NotificationRules;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.Notification.Rejected;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Translates a notification into records: one per entity, a tombstone for a deleted entity, and one dead letter per
 * unreadable entity. A notification that is unreadable as a whole, or whose records exceed the capacity of the source,
 * becomes one dead letter with the original bytes. No record is larger than {@link Settings#maxRecordBytes}.
 */
public final class NotificationTranslator {
    public static final String STAGE = "ngsi-source";

    private static final Logger LOG = LoggerFactory.getLogger(NotificationTranslator.class);
    private static final int MAX_MESSAGE_LENGTH = 500;
    private static final int HEADERS_AT_MOST = 32 * 1024;
    /** The bytes that the journal adds to a record. */
    private static final int JOURNAL_OVERHEAD = 100;
    /** Records are longer than the body, mostly because of their headers; never by more than this factor. */
    private static final int LARGEST_GROWTH = 256;

    /**
     * @param name of the connector, for {@code ce_source} if the notification names no subscription
     * @param excluded patterns of types; an entity whose whole type matches one is dropped
     * @param maxRecordBytes of one record
     * @param maxNotificationBytes of all records of a notification: a larger one can never become durable
     */
    public record Settings(
            String name,
            String topic,
            String deadLetterTopic,
            List<Pattern> excluded,
            EventTimeRule times,
            int maxRecordBytes,
            long maxNotificationBytes) {
        NotificationRules rules() {
            return new NotificationRules(name, excluded, times, Origin.NOTIFICATION);
        }
    }

    private final Settings settings;
    private final NotificationRules rules;
    private final Ledger ledger;
    private final Consumer<String> arrived;
    private final ClockFaults clocks = new ClockFaults(EntityOptions.MAX_CLOCK_SKEW);
    private final UndatedWarning undated = new UndatedWarning();

    public NotificationTranslator(Settings settings, Ledger ledger) {
        this(settings, ledger, subscription -> {});
    }

    /** @param arrived receives the subscription of each notification that names one */
    public NotificationTranslator(Settings settings, Ledger ledger, Consumer<String> arrived) {
        this.settings = settings;
        this.rules = settings.rules();
        this.ledger = ledger;
        this.arrived = arrived;
    }

    public Translation translate(ReceivedNotification received) {
        ledger.requests.increment();
        if (!received.complete()) {
            return refused(
                    received,
                    "the body is larger than " + received.body().length + " bytes; the rest was dropped (truncated)");
        }
        try {
            return translate(Notification.read(received.body(), received.attrsFormat()), received);
        } catch (UnreadableException e) {
            return refused(received, new Refusal(e.reason(), e.getMessage()));
        }
    }

    /** Rejects the notification for the given reason without parsing it. */
    public Translation refuse(ReceivedNotification received, String message) {
        ledger.requests.increment();
        return refused(received, message);
    }

    private Translation refused(ReceivedNotification received, String message) {
        return refused(received, new Refusal(Reason.TOO_LARGE, message));
    }

    private Translation translate(Notification notification, ReceivedNotification received) {
        String source = rules.source(notification);
        notification.subscriptionId().ifPresent(arrived);
        List<KafkaRecord> records = new ArrayList<>();
        for (int i = 0; i < notification.entities().size(); i++) {
            Entity entity = notification.entities().get(i);
            if (!rules.excludes(entity)) {
                try {
                    FiwareScope scope = NotificationRules.scope(notification, i, received.scope());
                    records.add(translate(entity, scope, source, received));
                } catch (UnreadableException e) {
                    records.add(deadLetter(entity.toBytes(), new Refusal(e.reason(), e.getMessage()), received));
                }
            }
        }
        for (Rejected rejected : notification.rejected()) {
            Refusal refusal = new Refusal(rejected.reason(), rejected.message());
            records.add(deadLetter(NgsiJson.write(rejected.reported()), refusal, received));
        }
        if (areTooLarge(records, received)) {
            return refused(
                    received,
                    "the records of the entities have more than " + settings.maxNotificationBytes()
                            + " bytes in total and can never fit into the journal; raise "
                            + JournalOptions.MAX_BYTES + ", or send fewer at a time");
        }
        count(notification, records);
        return new Translation(records, refusalOf(notification));
    }

    private boolean areTooLarge(List<KafkaRecord> records, ReceivedNotification received) {
        long most = settings.maxNotificationBytes();
        return (long) received.body().length * LARGEST_GROWTH > most
                && records.stream()
                                .mapToLong(record -> record.bytes() + JOURNAL_OVERHEAD)
                                .sum()
                        > most;
    }

    private void count(Notification notification, List<KafkaRecord> records) {
        int received = notification.entities().size() + notification.rejected().size();
        int dead = 0;
        for (KafkaRecord record : records) {
            dead += record.topic().equals(settings.deadLetterTopic()) ? 1 : 0;
        }
        ledger.received.add(received);
        ledger.excluded.add(received - records.size());
        ledger.dead.add(dead);
        ledger.accepted.add(records.size() - dead);
    }

    private KafkaRecord translate(Entity entity, FiwareScope scope, String source, ReceivedNotification received) {
        EntityRecord translated = rules.record(entity, scope, received.at(), source);
        KafkaRecord record = new KafkaRecord(
                settings.topic(),
                translated.key(),
                translated.value(),
                translated.time(),
                translated.headers(),
                EntityVersion.of(entity));
        if (entity.isDeleted()) {
            return record;
        }
        if (record.bytes() > settings.maxRecordBytes()) {
            String message = "the record of the entity has " + record.bytes() + " bytes, the limit is "
                    + settings.maxRecordBytes();
            return deadLetter(record.value(), new Refusal(Reason.TOO_LARGE, message), received);
        }
        if (translated.fault() != null) {
            counterOf(translated.fault()).increment();
            clocks.describe(scope.identity(entity.id()), translated.fault()).ifPresent(LOG::warn);
        }
        if (entity.value(Entity.MODIFIED).isEmpty()) {
            ledger.undated.increment();
            undated.note(source);
        }
        return record;
    }

    private LongAdder counterOf(EventTime.Fault fault) {
        return switch (fault) {
            case AHEAD -> ledger.clockAhead;
            case UNSET -> ledger.clockUnset;
            case UNREADABLE -> ledger.unreadableTime;
        };
    }

    /** A request without any usable entity is the sender's fault; one valid entity makes it a good request. */
    private static Optional<Refusal> refusalOf(Notification notification) {
        return notification.entities().isEmpty()
                ? notification.rejected().stream()
                        .findFirst()
                        .map(rejected -> new Refusal(rejected.reason(), rejected.message()))
                : Optional.empty();
    }

    private Translation refused(ReceivedNotification received, Refusal refusal) {
        ledger.received.increment();
        ledger.dead.increment();
        return new Translation(List.of(deadLetter(received.body(), refusal, received)), Optional.of(refusal));
    }

    private KafkaRecord deadLetter(byte[] original, Refusal refusal, ReceivedNotification received) {
        int room = settings.maxRecordBytes() - HEADERS_AT_MOST;
        boolean fits = original.length <= room;
        String message = shortened(refusal.message()) + (fits ? "" : " (truncated to " + room + " bytes)");
        DeadLetter letter = new DeadLetter(refusal.reason(), message, STAGE, shortened(received.sender()));
        byte[] value = fits ? original : Arrays.copyOf(original, room);
        return new KafkaRecord(settings.deadLetterTopic(), null, value, received.at(), letter.headers());
    }

    private static String shortened(String text) {
        return text.length() <= MAX_MESSAGE_LENGTH ? text : text.substring(0, MAX_MESSAGE_LENGTH) + "…";
    }
}
