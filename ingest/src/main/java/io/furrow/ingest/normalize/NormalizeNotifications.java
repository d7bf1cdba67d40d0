package io.furrow.ingest.normalize;

import java.io.Serializable;
import java.time.Instant;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.ClockFaults;
import io.furrow.model.event.EntityRecord;
import io.furrow.model.event.EventTime;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.NotificationRules;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.Notification.Rejected;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Converts a notification to records: one per entity, a tombstone for a deleted one; a dead letter per unreadable entity, or
 * for the whole notification. The time of receipt is the notification's record timestamp, so that reading it again yields
 * the same events.
 */
public final class NormalizeNotifications extends ProcessFunction<TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(NormalizeNotifications.class);
    static final String STAGE = "normalize";
    private static final String ATTRS_FORMAT = "ngsiv2-attrsformat";

    record Settings(String output, NotificationRules rules, int maxRecordBytes) implements Serializable {}

    private final Settings settings;
    private transient Counter accepted;
    private transient Counter excluded;
    private transient Map<EventTime.Fault, Counter> faults;
    private transient ClockFaults clocks;
    private transient DeadLetterCounters dead;

    NormalizeNotifications(Settings settings) {
        this.settings = settings;
    }

    @Override
    public void open(OpenContext context) {
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        accepted = metrics.counter("accepted");
        excluded = metrics.counter("excluded");
        faults = Map.of(
                EventTime.Fault.AHEAD, metrics.counter("clockAhead"),
                EventTime.Fault.UNSET, metrics.counter("clockUnset"),
                EventTime.Fault.UNREADABLE, metrics.counter("unreadableTime"));
        clocks = new ClockFaults(NormalizeOptions.MAX_CLOCK_SKEW);
        dead = new DeadLetterCounters(metrics);
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<TopicRecord> out) {
        try {
            Notification notification = read(record);
            for (Rejected rejected : notification.rejected()) {
                setAside(
                        valued(record, NgsiJson.write(rejected.reported())),
                        new UnreadableException(rejected.reason(), rejected.message()),
                        context);
            }
            for (int i = 0; i < notification.entities().size(); i++) {
                emit(notification, i, record, context, out);
            }
        } catch (UnreadableException e) {
            setAside(record, e, context);
        }
    }

    private static Notification read(TopicRecord record) throws UnreadableException {
        if (record.value() == null) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the notification has no value");
        }
        return Notification.read(record.value(), header(record, ATTRS_FORMAT));
    }

    private void emit(
            Notification notification, int index, TopicRecord record, Context context, Collector<TopicRecord> out) {
        Entity entity = notification.entities().get(index);
        if (settings.rules().excludes(entity)) {
            excluded.inc();
            return;
        }
        FiwareScope scope;
        try {
            scope = NotificationRules.scope(notification, index, scope(record));
        } catch (UnreadableException e) {
            setAside(valued(record, entity.toBytes()), e, context);
            return;
        }
        EntityRecord translated = settings.rules()
                .record(entity, scope, received(record), settings.rules().source(notification));
        if (translated.fault() != null) {
            faults.get(translated.fault()).inc();
            clocks.describe(scope.identity(entity.id()), translated.fault()).ifPresent(LOG::warn);
        }
        TopicRecord event = TopicRecord.of(
                settings.output(),
                translated.time().toEpochMilli(),
                translated.key(),
                translated.value(),
                translated.headers());
        if (bytes(event) > settings.maxRecordBytes()) {
            String message = "the entity makes a record of " + bytes(event) + " bytes, the limit is "
                    + settings.maxRecordBytes();
            setAside(record, new UnreadableException(Reason.TOO_LARGE, message), context);
            return;
        }
        accepted.inc();
        out.collect(event);
    }

    private void setAside(TopicRecord record, UnreadableException why, Context context) {
        dead.count(why.reason());
        context.output(DeadLetters.TAG, DeadLetters.of(record, why, STAGE));
    }

    private static TopicRecord valued(TopicRecord record, byte[] value) {
        return new TopicRecord(
                record.topic(),
                record.partition(),
                record.offset(),
                record.timestamp(),
                record.key(),
                value,
                record.headers());
    }

    private static Instant received(TopicRecord record) {
        return Instant.ofEpochMilli(Math.max(0, record.timestamp()));
    }

    private static FiwareScope scope(TopicRecord record) {
        return FiwareScope.of(header(record, HeaderNames.SERVICE), header(record, HeaderNames.SERVICE_PATH));
    }

    /** The context broker writes {@code Fiware-Service} over HTTP; headers in Kafka are case-sensitive. */
    private static String header(TopicRecord record, String name) {
        for (Map.Entry<String, String> header : record.headers().entrySet()) {
            if (header.getKey().equalsIgnoreCase(name)) {
                return header.getValue();
            }
        }
        return null;
    }

    private static int bytes(TopicRecord record) {
        int bytes = record.key().length + (record.value() == null ? 0 : record.value().length);
        for (Map.Entry<String, String> header : record.headers().entrySet()) {
            bytes += header.getKey().length() + 3 * header.getValue().length();
        }
        return bytes;
    }
}
