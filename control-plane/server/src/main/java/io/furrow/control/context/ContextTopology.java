package io.furrow.control.context;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;

import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.control.alarm.watch.EncounterReport;
import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Observer;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.StateJson;
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
            "context-reported");

    private final ManagerTopology topology;
    private final FiwareScope scope;

    private ContextTopology(ManagerTopology topology, FiwareScope scope) {
        this.topology = topology;
        this.scope = scope;
    }

    /**
     * The streams from which alarms are raised too, each in a single partition: {@code data.collision}, {@code
     * data.temperature} and {@code service.missions.status}.
     */
    public record Shared(
            KStream<String, byte[]> collisions,
            KStream<String, byte[]> temperatures,
            KStream<String, byte[]> statuses) {}

    /** @param scope of the entities */
    public static void add(ManagerTopology topology, Shared shared, FiwareScope scope) {
        topology.addStores(STORES);
        ContextTopology watch = new ContextTopology(topology, scope);

        watch.observe(
                "domains",
                Topics.DOMAINS,
                projection -> new TimedObserver(
                        (record, now) -> projection.domain(record.key(), read(record, Domain.class)), projection));

        watch.observe(
                "missions",
                Topics.MISSIONS,
                projection -> (record, now) -> projection.mission(record.key(), read(record, Mission.class)));

        watch.observe(
                "statuses",
                shared.statuses(),
                false,
                projection -> (record, now) -> projection.status(record.key(), read(record, MissionStatus.class)));

        watch.observe("encounters", shared.collisions(), false, projection -> (record, now) -> {
            if (record.value() != null) {
                projection.encounter(EncounterReport.read(record.value(), KafkaClients.scope(record.headers())));
            }
        });

        watch.observe("fields", shared.temperatures(), false, projection -> (record, now) -> {
            FieldWindow window = record.value() == null ? null : FieldWindow.of(Entity.parse(record.value()));
            if (window != null) {
                projection.window(window, KafkaClients.scope(record.headers()), now);
            }
        });
    }

    private void observe(String name, String topic, Function<ContextProjection, Observer> observerFactory) {
        observe(name, topology.observed(topic, "context-" + name, AutoOffsetReset.earliest()), true, observerFactory);
    }

    /** @param writesUnreadable false for shared streams: the processors that raise alarms write their dead letters */
    private void observe(
            String name,
            KStream<String, byte[]> records,
            boolean writesUnreadable,
            Function<ContextProjection, Observer> observerFactory) {
        ManagerTopology.observe(
                records,
                new ManagerTopology.Nodes("context-of-" + name, "context-of-" + name + "-out"),
                writesUnreadable,
                unitOfWork -> observerFactory.apply(projection(unitOfWork)),
                STORES);
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

    private ContextProjection projection(UnitOfWork unitOfWork) {
        ContextTables records = new ContextTables(
                unitOfWork.table(STORES.get(0), Domain.class),
                unitOfWork.table(STORES.get(1), Mission.class),
                unitOfWork.table(STORES.get(2), MissionStatus.class),
                unitOfWork.table(STORES.get(3), MissionCounts.class),
                unitOfWork.table(STORES.get(4), FieldState.class),
                unitOfWork.table(STORES.get(5), String.class),
                unitOfWork.table(STORES.get(6)));
        return new ContextProjection(records, new EntityForwarder(unitOfWork, scope));
    }

    /** Forwards entities as records of {@code data.context}, with the headers of all {@code data.*} topics. */
    private record EntityForwarder(UnitOfWork unitOfWork, FiwareScope scope)
            implements ContextProjection.PublicationListener {
        @Override
        public void changed(EntityBuilder entity) {
            Instant now = Instant.ofEpochMilli(unitOfWork.now());
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
            Instant now = Instant.ofEpochMilli(unitOfWork.now());
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
            unitOfWork.forward(record);
        }
    }
}
