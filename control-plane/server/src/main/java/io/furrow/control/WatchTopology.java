package io.furrow.control;

import java.time.Duration;

import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.kstream.KStream;

import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.alarm.watch.AnalyticsAlarms;
import io.furrow.control.alarm.watch.EncounterAlarmProcessor;
import io.furrow.control.context.ContextTopology;
import io.furrow.control.health.HealthWatch;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

/** Builds the topology of the farm watch: health of devices, alarms, entities of domains and missions. */
final class WatchTopology {
    /** At the first start, older results raise no alarms. */
    private static final AutoOffsetReset RECENT = AutoOffsetReset.byDuration(Duration.ofMinutes(10));

    private WatchTopology() {}

    /**
     * @param requestRetention how long ids of requests are stored for deduplication
     * @param scope of the entities of domains and missions, and of the devices of missions
     */
    static Topology of(Duration requestRetention, WatchOptions options, FiwareScope scope) {
        ManagerTopology topology = new ManagerTopology(requestRetention);

        AlarmManager.add(topology);

        HealthWatch.add(topology, options.health());

        AnalyticsAlarms.Types types = new AnalyticsAlarms.Types(HealthWatch::typeOf, HealthWatch.stores());
        KStream<String, byte[]> collisions = observed(topology, Topics.COLLISION, "collisions");
        AnalyticsAlarms.addEncounters(
                collisions,
                types,
                new EncounterAlarmProcessor.AlarmDurations(options.predictionValidity(), options.collisionValidity()));

        KStream<String, byte[]> temperatures = observed(topology, Topics.TEMPERATURE, "temperatures");
        AnalyticsAlarms.addSensors(temperatures, types);

        AnalyticsAlarms.addClocks(observed(topology, Topics.CLOCKS, "clocks"), types);

        AnalyticsAlarms.addFaults(observed(topology, Topics.FAULTS, "faults"), types);

        KStream<String, byte[]> statuses =
                topology.observed(Topics.MISSIONS_STATUS, "context-mission-statuses", AutoOffsetReset.earliest());
        AnalyticsAlarms.addStarts(statuses, types, scope);

        ContextTopology.add(topology, new ContextTopology.Shared(collisions, temperatures, statuses), scope);

        return topology.build();
    }

    private static KStream<String, byte[]> observed(ManagerTopology topology, String topic, String name) {
        return topology.observed(topic, name, RECENT);
    }
}
