package io.furrow.control.context;

import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.ProcessorSupplier;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.Encounter;
import io.furrow.control.alarm.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.manager.Inlet;
import io.furrow.control.manager.ObserveRecords;
import io.furrow.control.manager.ObserveRecords.Observer;
import io.furrow.control.manager.Outgoing;
import io.furrow.control.manager.RecordScope;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.StoreRecords;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads what is known of domains and missions and writes their entities to {@code data.context}. */
public final class ContextWatch {
    private static final String SOURCE = "/control-plane";
    private static final List<String> STORES = List.of(
            "context-domains",
            "context-missions",
            "context-statuses",
            "context-tallies",
            "context-fields",
            "context-outdated",
            "context-told");

    private final StreamsBuilder builder;
    private final FiwareScope scope;

    private ContextWatch(StreamsBuilder builder, FiwareScope scope) {
        this.builder = builder;
        this.scope = scope;
    }

    /** What analytics find, in one line each: the records of {@code data.collision} and {@code data.temperature}. */
    public record Results(KStream<String, byte[]> collisions, KStream<String, byte[]> temperatures) {}

    /** @param scope of the entities */
    public static void add(StreamsBuilder builder, Results results, FiwareScope scope) {
        STORES.forEach(store -> builder.addStateStore(StoreRecords.builder(store)));
        ContextWatch watch = new ContextWatch(builder, scope);

        watch.send(
                "domains",
                watch.wanted(Topics.DOMAINS, "domains"),
                desk -> new Telling((record, now) -> desk.domain(record.key(), read(record, Domain.class)), desk));

        watch.send(
                "missions",
                watch.wanted(Topics.MISSIONS, "missions"),
                desk -> (record, now) -> desk.mission(record.key(), read(record, Mission.class)));

        watch.send(
                "statuses",
                watch.wanted(Topics.MISSIONS_STATUS, "mission-statuses"),
                desk -> (record, now) -> desk.status(record.key(), read(record, MissionStatus.class)));

        watch.sendResults("encounters", results.collisions(), desk -> (record, now) -> {
            if (record.value() != null) {
                desk.encounter(Encounter.read(record.value(), RecordScope.of(record)));
            }
        });

        watch.sendResults("fields", results.temperatures(), desk -> (record, now) -> {
            FieldWindow window = record.value() == null ? null : FieldWindow.of(Entity.parse(record.value()));
            if (window != null) {
                desk.window(window, now);
            }
        });
    }

    private KStream<String, byte[]> wanted(String topic, String name) {
        return Inlet.observed(builder, topic, "context-" + name, AutoOffsetReset.earliest());
    }

    private void send(String name, KStream<String, byte[]> records, Function<ContextDesk, Observer> observing) {
        send(name, records, () -> new ObserveRecords((context, outbox) -> observing.apply(desk(context))));
    }

    /** Results have dead letters already, of the processors that make alarms of them. */
    private void sendResults(String name, KStream<String, byte[]> results, Function<ContextDesk, Observer> observing) {
        send(name, results, () -> ObserveRecords.besideAnother((context, outbox) -> observing.apply(desk(context))));
    }

    private void send(
            String name,
            KStream<String, byte[]> records,
            ProcessorSupplier<String, byte[], String, Outgoing> observers) {
        Outgoing.send(
                records.process(observers, Named.as("context-of-" + name), STORES.toArray(String[]::new)),
                "context-of-" + name + "-out");
    }

    /** One of the observers lets the desk know that time passes. */
    private record Telling(Observer observer, ContextDesk desk) implements Observer {
        @Override
        public void take(Record<String, byte[]> record, long now) throws UnreadableException {
            observer.take(record, now);
        }

        @Override
        public void passTime(long now) {
            desk.passTime(now);
        }
    }

    private static <T> T read(Record<String, byte[]> record, Class<T> type) throws UnreadableException {
        try {
            return record.value() == null ? null : StateJson.read(record.value(), type);
        } catch (UncheckedIOException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, e.getMessage(), e);
        }
    }

    private ContextDesk desk(ProcessorContext<String, Outgoing> context) {
        ContextRecords records = new ContextRecords(
                StoreRecords.of(context, STORES.get(0), Domain.class),
                StoreRecords.of(context, STORES.get(1), Mission.class),
                StoreRecords.of(context, STORES.get(2), MissionStatus.class),
                StoreRecords.of(context, STORES.get(3), MissionTally.class),
                StoreRecords.of(context, STORES.get(4), FieldState.class),
                StoreRecords.of(context, STORES.get(5), String.class),
                StoreRecords.of(context, STORES.get(6), Function.identity(), Function.identity()));
        return new ContextDesk(records, new Forwarding(context, scope));
    }

    /** Entities as records of {@code data.context}, with the headers that all {@code data.*} have. */
    private record Forwarding(ProcessorContext<String, Outgoing> context, FiwareScope scope)
            implements ContextDesk.Told {
        @Override
        public void changed(EntityBuilder entity) {
            Instant now = Instant.ofEpochMilli(context.currentSystemTimeMs());
            Map<String, String> headers = new LinkedHashMap<>();
            headers.put(HeaderNames.CE_ID, EventId.of(scope, entity, now));
            headers.put(HeaderNames.CE_SOURCE, SOURCE);
            headers.put(HeaderNames.CE_TIME, now.toString());
            headers.put(HeaderNames.CE_SPECVERSION, HeaderNames.SPECVERSION);
            headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
            headers.put(HeaderNames.SERVICE, scope.service());
            headers.put(HeaderNames.SERVICE_PATH, scope.servicePath());
            headers.put(HeaderNames.TS_DEVICE, Long.toString(now.toEpochMilli()));
            forward(entity.id(), entity.toBytes(), headers, now);
        }

        @Override
        public void deleted(String entityId) {
            Instant now = Instant.ofEpochMilli(context.currentSystemTimeMs());
            Map<String, String> headers = new LinkedHashMap<>(
                    new EntityDeletion(entityId, scope, now, now, Origin.NOTIFICATION).headers(SOURCE));
            headers.remove(HeaderNames.ORIGIN);
            headers.remove(HeaderNames.TS_SOURCE);
            forward(entityId, null, headers, now);
        }

        private void forward(String key, byte[] value, Map<String, String> headers, Instant now) {
            Record<String, Outgoing> record =
                    new Record<>(key, new Outgoing(Topics.CONTEXT, value), now.toEpochMilli());
            headers.forEach((name, text) -> record.headers().add(name, text.getBytes(StandardCharsets.UTF_8)));
            context.forward(record);
        }
    }
}
