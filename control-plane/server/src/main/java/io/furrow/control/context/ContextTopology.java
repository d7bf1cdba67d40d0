package io.furrow.control.context;

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

import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ObserverProcessor;
import io.furrow.control.manager.ObserverProcessor.Observer;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.RecordScope;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Reads domains and missions and writes their entities to {@code data.context}. */
public final class ContextTopology {
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

    private ContextTopology(StreamsBuilder builder, FiwareScope scope) {
        this.builder = builder;
        this.scope = scope;
    }

    /**
     * What alarms are raised from too, in a single partition each: the records of {@code data.collision}, of
     * {@code data.temperature} and of {@code service.missions.status}.
     */
    public record Shared(
            KStream<String, byte[]> collisions,
            KStream<String, byte[]> temperatures,
            KStream<String, byte[]> statuses) {}

    /** @param scope of the entities */
    public static void add(StreamsBuilder builder, Shared shared, FiwareScope scope) {
        STORES.forEach(store -> builder.addStateStore(StoreTable.builder(store)));
        ContextTopology watch = new ContextTopology(builder, scope);

        watch.send(
                "domains",
                watch.desired(Topics.DOMAINS, "domains"),
                projection -> new TimedObserver(
                        (record, now) -> projection.domain(record.key(), read(record, Domain.class)), projection));

        watch.send(
                "missions",
                watch.desired(Topics.MISSIONS, "missions"),
                projection -> (record, now) -> projection.mission(record.key(), read(record, Mission.class)));

        watch.sendShared(
                "statuses",
                shared.statuses(),
                projection -> (record, now) -> projection.status(record.key(), read(record, MissionStatus.class)));

        watch.sendShared("encounters", shared.collisions(), projection -> (record, now) -> {
            if (record.value() != null) {
                projection.encounter(EncounterReport.read(record.value(), RecordScope.of(record)));
            }
        });

        watch.sendShared("fields", shared.temperatures(), projection -> (record, now) -> {
            FieldWindow window = record.value() == null ? null : FieldWindow.of(Entity.parse(record.value()));
            if (window != null) {
                projection.window(window, now);
            }
        });
    }

    private KStream<String, byte[]> desired(String topic, String name) {
        return ManagerInput.observed(builder, topic, "context-" + name, AutoOffsetReset.earliest());
    }

    private void send(String name, KStream<String, byte[]> records, Function<ContextProjection, Observer> observing) {
        send(name, records, () -> new ObserverProcessor((context, publisher) -> observing.apply(projection(context))));
    }

    /** Does not write dead letters: the processors that raise alarms from the same records already do. */
    private void sendShared(
            String name, KStream<String, byte[]> records, Function<ContextProjection, Observer> observing) {
        send(
                name,
                records,
                () -> ObserverProcessor.besideAnother((context, publisher) -> observing.apply(projection(context))));
    }

    private void send(
            String name,
            KStream<String, byte[]> records,
            ProcessorSupplier<String, byte[], String, OutputRecord> observers) {
        OutputRecord.send(
                records.process(observers, Named.as("context-of-" + name), STORES.toArray(String[]::new)),
                "context-of-" + name + "-out");
    }

    /** The one observer that notifies the projection about the passing of time. */
    private record TimedObserver(Observer observer, ContextProjection projection) implements Observer {
        @Override
        public void take(Record<String, byte[]> record, long now) throws UnreadableException {
            observer.take(record, now);
        }

        @Override
        public void passTime(long now) {
            projection.passTime(now);
        }
    }

    private static <T> T read(Record<String, byte[]> record, Class<T> type) throws UnreadableException {
        return record.value() == null ? null : StateJson.readRecord(record.value(), type);
    }

    private ContextProjection projection(ProcessorContext<String, OutputRecord> context) {
        ContextTables records = new ContextTables(
                StoreTable.of(context, STORES.get(0), Domain.class),
                StoreTable.of(context, STORES.get(1), Mission.class),
                StoreTable.of(context, STORES.get(2), MissionStatus.class),
                StoreTable.of(context, STORES.get(3), MissionCounts.class),
                StoreTable.of(context, STORES.get(4), FieldState.class),
                StoreTable.of(context, STORES.get(5), String.class),
                StoreTable.of(context, STORES.get(6), Function.identity(), Function.identity()));
        return new ContextProjection(records, new EntityForwarder(context, scope));
    }

    /** Forwards entities as records of {@code data.context}, with the headers of all {@code data.*} topics. */
    private record EntityForwarder(ProcessorContext<String, OutputRecord> context, FiwareScope scope)
            implements ContextProjection.PublicationListener {
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
        public void deleted(String type, String entityId) {
            Instant now = Instant.ofEpochMilli(context.currentSystemTimeMs());
            Map<String, String> headers = new LinkedHashMap<>(
                    new EntityDeletion(type, entityId, scope, now, now, Origin.NOTIFICATION).headers(SOURCE));
            headers.remove(HeaderNames.ORIGIN);
            headers.remove(HeaderNames.TS_SOURCE);
            forward(entityId, null, headers, now);
        }

        private void forward(String key, byte[] value, Map<String, String> headers, Instant now) {
            Record<String, OutputRecord> record =
                    new Record<>(key, new OutputRecord(Topics.CONTEXT, value), now.toEpochMilli());
            headers.forEach((name, text) -> record.headers().add(name, text.getBytes(StandardCharsets.UTF_8)));
            context.forward(record);
        }
    }
}
