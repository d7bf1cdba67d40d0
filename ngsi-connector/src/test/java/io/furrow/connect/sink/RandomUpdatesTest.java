package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.BrokerSettings;
import io.furrow.connect.broker.Outcome;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static org.assertj.core.api.Assertions.assertThat;

/** Partial updates in any order, over any deliveries, end in the state that event time says: against the stand-in. */
class RandomUpdatesTest {
    private static final FiwareScope FARM = FiwareScope.of("farm", "/");
    private static final int ENTITIES = 50;
    private static final int CHANGES = 400;

    private final long seed = Long.getLong("furrow.seed", new Random().nextLong());
    private final Random random = new Random(seed);
    private final FiwareStandIn standIn = FiwareStandIn.start(new FiwareSettings(0, 0, null, null, null));
    private final BrokerClient client =
            new BrokerClient(BrokerSettings.of(standIn.contextBroker(), java.time.Duration.ofSeconds(10)));

    private enum Mishap {
        NONE,
        RESTARTS,
        EVICTIONS,
        DELETIONS
    }

    @ParameterizedTest
    @EnumSource(Mishap.class)
    void endInTheNewestValueOfEachAttribute(Mishap mishap) throws Exception {
        Map<String, Map<String, Long>> model = new TreeMap<>();
        List<SinkRecord> records = records(mishap, model);
        Collections.shuffle(records, random);
        try {
            NgsiSinkTask task = task(mishap);
            for (int from = 0; from < records.size(); ) {
                int to = Math.min(records.size(), from + 1 + random.nextInt(120));
                task.put(records.subList(from, to));
                if (random.nextInt(4) == 0) {
                    task.put(records.subList(from, to));
                }
                if (mishap == Mishap.RESTARTS && random.nextInt(3) == 0) {
                    task.stop();
                    task = task(mishap);
                }
                from = to;
            }
            task.stop();
            assertThat(stored()).isEqualTo(model);
        } catch (Exception | AssertionError e) {
            throw new AssertionError("with -Dfurrow.seed=" + seed, e);
        } finally {
            standIn.close();
        }
    }

    /** Every record has a time of its own; the value of an attribute is the time at which it was set. */
    private List<SinkRecord> records(Mishap mishap, Map<String, Map<String, Long>> model) {
        List<SinkRecord> records = new ArrayList<>();
        for (int i = 0; i < CHANGES; i++) {
            long time = 1_700_000_000_000L + i;
            String id = "e" + random.nextInt(ENTITIES);
            if (mishap == Mishap.DELETIONS && random.nextInt(6) == 0) {
                model.remove(id);
                records.add(record(id, null, time));
                continue;
            }
            EntityBuilder entity = Entity.builder(id, "T");
            int always = random.nextInt(6);
            for (int attribute = 0; attribute < 6; attribute++) {
                if (attribute == always || random.nextInt(6) == 0) {
                    entity.integer("a" + attribute, time);
                    model.computeIfAbsent(id, any -> new TreeMap<>()).put("a" + attribute, time);
                }
            }
            records.add(record(id, entity.build().toBytes(), time));
        }
        return records;
    }

    private static SinkRecord record(String id, byte[] value, long time) {
        return new SinkRecord("t", 0, null, id, null, value, time, time, TimestampType.CREATE_TIME);
    }

    private NgsiSinkTask task(Mishap mishap) {
        NgsiSinkTask task = new NgsiSinkTask();
        task.initialize(new FakeSinkContext(false));
        task.start(Map.of(
                "context.broker.url", standIn.contextBroker().toString(),
                "fiware.service", "farm",
                "batch.size", "5",
                "delete.on.null", "true",
                "known.attributes.max", mishap == Mishap.EVICTIONS ? "10" : "1000000"));
        return task;
    }

    private Map<String, Map<String, Long>> stored() throws Exception {
        Outcome.Done answer = (Outcome.Done) client.send(BrokerRequest.get(FARM, "/v2/entities?limit=1000"));
        Map<String, Map<String, Long>> stored = new TreeMap<>();
        for (JsonNode entity : answer.json()) {
            Map<String, Long> values = stored.computeIfAbsent(entity.path("id").textValue(), any -> new TreeMap<>());
            Entity.of(entity)
                    .attributes()
                    .forEach(attribute -> values.put(
                            attribute.getKey(),
                            attribute.getValue().path("value").longValue()));
        }
        return stored;
    }
}
