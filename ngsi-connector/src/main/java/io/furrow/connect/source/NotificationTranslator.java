package io.furrow.connect.source;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;
import java.util.function.Consumer;
import java.util.regex.Pattern;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.repair.EntityVersion;
import io.furrow.connect.source.Translation.Refusal;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTime;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.Notification.Rejected;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Turns a notification into records: one per entity, without a value where it was deleted, one dead letter per entity that cannot be read, and one dead letter
 * with the original bytes where nothing can be read, or more than the source can hold would come of it. No record is larger than
 * {@link Settings#maxRecordBytes}.
 */
final class NotificationTranslator {
    static final String STAGE = "ngsi-source";

    private static final Pattern SUBSCRIPTION = Pattern.compile("[A-Za-z0-9_.:-]{1,128}");
    private static final int LONGEST_MESSAGE = 500;
    private static final int HEADERS_AT_MOST = 32 * 1024;
    /** What the journal adds to a record. */
    private static final int JOURNAL_OVERHEAD = 100;
    /** Records are longer than the body, mostly by their headers; never by more than this. */
    private static final int LARGEST_GROWTH = 256;

    /**
     * @param name of the connector, for {@code ce_source} where no subscription is named
     * @param excluded entities of a type that one of these matches as a whole are dropped
     * @param maxRecordBytes of one record
     * @param maxNotificationBytes of all records of a notification: what is larger can never be made durable
     */
    record Settings(
            String name,
            String topic,
            String deadLetterTopic,
            List<Pattern> excluded,
            EventTimeRule times,
            int maxRecordBytes,
            long maxNotificationBytes) {}

    private final Settings settings;
    private final Ledger ledger;
    private final Consumer<String> arrived;
    private final ClockReport clocks = new ClockReport();
    private final UndatedReport undated = new UndatedReport();

    NotificationTranslator(Settings settings, Ledger ledger) {
        this(settings, ledger, subscription -> {});
    }

    /** @param arrived is told the subscription of each notification that names one */
    NotificationTranslator(Settings settings, Ledger ledger, Consumer<String> arrived) {
        this.settings = settings;
        this.ledger = ledger;
        this.arrived = arrived;
    }

    Translation translate(ReceivedNotification received) {
        ledger.requests.increment();
        if (!received.complete()) {
            return refused(
                    received,
                    "the body is larger than " + received.body().length + " bytes; only these were kept (truncated)");
        }
        try {
            return translate(Notification.read(received.body(), received.attrsFormat()), received);
        } catch (UnreadableException e) {
            return refused(received, new Refusal(e.reason(), e.getMessage()));
        }
    }

    /** Does not even read it, for this reason. */
    Translation refuse(ReceivedNotification received, String message) {
        ledger.requests.increment();
        return refused(received, message);
    }

    private Translation refused(ReceivedNotification received, String message) {
        return refused(received, new Refusal(Reason.TOO_LARGE, message));
    }

    private Translation translate(Notification notification, ReceivedNotification received) {
        String source = "/ngsi/"
                + notification
                        .subscriptionId()
                        .filter(id -> SUBSCRIPTION.matcher(id).matches())
                        .orElse(settings.name());
        notification.subscriptionId().ifPresent(arrived);
        List<OutgoingRecord> records = new ArrayList<>();
        for (Entity entity : notification.entities()) {
            if (!isExcluded(entity)) {
                records.add(translate(entity, source, received));
            }
        }
        for (Rejected rejected : notification.rejected()) {
            Refusal refusal = new Refusal(rejected.reason(), rejected.message());
            records.add(deadLetter(NgsiJson.write(rejected.reported()), refusal, received));
        }
        if (areTooLarge(records, received)) {
            return refused(
                    received,
                    "the entities make records of more than " + settings.maxNotificationBytes()
                            + " bytes together, and the journal never has room for them; raise "
                            + JournalOptions.MAX_BYTES + ", or send fewer at a time");
        }
        count(notification, records);
        return new Translation(records, refusalOf(notification));
    }

    private boolean areTooLarge(List<OutgoingRecord> records, ReceivedNotification received) {
        long most = settings.maxNotificationBytes();
        return (long) received.body().length * LARGEST_GROWTH > most
                && records.stream()
                                .mapToLong(record -> record.bytes() + JOURNAL_OVERHEAD)
                                .sum()
                        > most;
    }

    private void count(Notification notification, List<OutgoingRecord> records) {
        int received = notification.entities().size() + notification.rejected().size();
        int dead = 0;
        for (OutgoingRecord record : records) {
            dead += record.topic().equals(settings.deadLetterTopic()) ? 1 : 0;
        }
        ledger.received.add(received);
        ledger.excluded.add(received - records.size());
        ledger.dead.add(dead);
        ledger.accepted.add(records.size() - dead);
    }

    private boolean isExcluded(Entity entity) {
        for (Pattern type : settings.excluded()) {
            if (type.matcher(entity.type()).matches()) {
                return true;
            }
        }
        return false;
    }

    private OutgoingRecord translate(Entity entity, String source, ReceivedNotification received) {
        if (entity.isDeleted()) {
            return deletion(entity, source, received);
        }
        EntityEvent event =
                EntityEvent.of(entity, received.scope(), received.at(), settings.times(), Origin.NOTIFICATION);
        OutgoingRecord record = new OutgoingRecord(
                settings.topic(),
                entity.id(),
                entity.toBytes(),
                event.time().time(),
                event.headers(source),
                EntityVersion.of(entity));
        if (record.bytes() > settings.maxRecordBytes()) {
            String message = "the entity makes a record of " + record.bytes() + " bytes, the limit is "
                    + settings.maxRecordBytes();
            return deadLetter(record.value(), new Refusal(Reason.TOO_LARGE, message), received);
        }
        if (event.time().basis() == EventTime.Basis.RECEIPT_FOR_FUTURE) {
            ledger.clockAhead.increment();
            clocks.note(event);
        }
        if (entity.value(Entity.MODIFIED).isEmpty()) {
            ledger.undated.increment();
            undated.note(source);
        }
        return record;
    }

    private OutgoingRecord deletion(Entity entity, String source, ReceivedNotification received) {
        EntityDeletion deletion = EntityDeletion.of(
                entity, received.scope(), received.at(), settings.times().maxSkew(), Origin.NOTIFICATION);
        return new OutgoingRecord(
                settings.topic(),
                entity.id(),
                null,
                deletion.time(),
                deletion.headers(source),
                EntityVersion.of(entity));
    }

    /** A request of which nothing can be used is the sender's fault; one good entity makes it a good request. */
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

    private OutgoingRecord deadLetter(byte[] original, Refusal refusal, ReceivedNotification received) {
        int room = settings.maxRecordBytes() - HEADERS_AT_MOST;
        boolean fits = original.length <= room;
        String message = shortened(refusal.message()) + (fits ? "" : " (truncated to " + room + " bytes)");
        DeadLetter letter = new DeadLetter(refusal.reason(), message, STAGE, shortened(received.sender()));
        byte[] value = fits ? original : Arrays.copyOf(original, room);
        return new OutgoingRecord(settings.deadLetterTopic(), null, value, received.at(), letter.headers());
    }

    private static String shortened(String text) {
        return text.length() <= LONGEST_MESSAGE ? text : text.substring(0, LONGEST_MESSAGE) + "…";
    }
}
