package io.furrow.ingest.route;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.List;
import java.util.Optional;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.DeviceLookup;
import io.furrow.flink.device.DeviceVersions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.ByType;
import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.DeadLetters;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Assigns each event to a domain and a mission: by its attributes, else by {@code service.devices} as of the event's time,
 * else by default. A deletion, which names none, follows the entity's newest event; one without a type deletes all entities of
 * the id. A name beyond the {@link NameBudget} goes to a dead letter, and the event continues without it.
 *
 * <p>State: the newest route per entity, by type; every device's versions, the same in each subtask. Cleared: the route by the
 * deletion, ended versions after their retention. Late: an event is assigned as of its own time, and does not change the route
 * of a newer one. Emits: every event once, a deletion of several entities once for each.
 */
public final class AssignMission
        extends KeyedBroadcastProcessFunction<String, ReportedEvent, DeviceChange, ReportedEvent> {
    /** The devices, by identity. */
    public static final MapStateDescriptor<String, DeviceVersions> DEVICES =
            new MapStateDescriptor<>("devices", Types.STRING, TypeInformation.of(DeviceVersions.class));

    private static final ByType.Descriptor<CachedRoute> ROUTE =
            new ByType.Descriptor<>("route", CachedRoute.class, CachedRoute::type);

    private static final long serialVersionUID = 1L;
    /** The stage in dead letters of events that continued. */
    private static final String STAGE = "routes";

    /**
     * The configured rule.
     *
     * @param kept how long ended versions are retained for late events
     * @param defaultDomain empty if there is none, like {@code defaultMission}
     */
    public record Rule(Duration kept, String defaultDomain, String defaultMission) implements Serializable {}

    private final DeviceLookup devices;
    private final Rule rule;
    private final NameBudget names;
    private transient ByType<CachedRoute> routes;
    private transient DeadLetterCounters dead;

    public AssignMission(TopicSnapshot devicesAtStart, Rule rule, NameBudget names) {
        this.names = names;
        this.devices = new DeviceLookup(devicesAtStart, rule.kept());
        this.rule = rule;
    }

    /** Reads the existing devices before the first event, also after each restart. */
    @Override
    public void open(OpenContext context) throws IOException {
        routes = ROUTE.of(getRuntimeContext());
        devices.open();
        names.open();
        dead = new DeadLetterCounters(getRuntimeContext().getMetricGroup());
    }

    @Override
    public void processElement(ReportedEvent event, ReadOnlyContext context, Collector<ReportedEvent> out)
            throws Exception {
        if (event.isDeletion()) {
            deleted(event, context, out);
        } else {
            out.collect(assigned(event, context));
        }
    }

    private ReportedEvent assigned(ReportedEvent event, ReadOnlyContext context) throws Exception {
        ReportedEvent complete =
                event.domain().isEmpty() || event.mission().isEmpty() ? completed(event, context) : event;
        CachedRoute known = routes.get(event.type());
        ReportedEvent assigned = admitted(event, complete, known, context);
        if (known == null || known.time() <= event.time()) {
            routes.put(
                    event.type(),
                    new CachedRoute(
                            event.type(), assigned.domain(), assigned.mission(), event.time(), event.received()));
        }
        return assigned;
    }

    /** Removes names that are not admitted. */
    private ReportedEvent admitted(
            ReportedEvent event, ReportedEvent assigned, CachedRoute known, ReadOnlyContext context) throws Exception {
        String domain = assigned.domain();
        boolean inUse = known != null && known.domain().equals(domain);
        long now = context.currentProcessingTime();
        String admitted = "";
        try {
            if (!event.domain().isEmpty() && !inUse) {
                names.checkDomain(domain, now);
            }
            admitted = domain;
            if (!event.mission().isEmpty()) {
                boolean same = inUse && known.mission().equals(event.mission()) || isOfDevice(event, domain, context);
                names.checkMission(domain, event.mission(), same, event.time(), now);
            }
            return assigned;
        } catch (UnreadableException e) {
            dead.count(e.reason());
            context.output(DeadLetters.TAG, DeadLetters.of(event.record(), e, STAGE));
            return event.belongingTo(admitted, "");
        }
    }

    /** Whether the control plane assigns the device itself to this mission. */
    private boolean isOfDevice(ReportedEvent event, String domain, ReadOnlyContext context) throws Exception {
        return devices.at(event.identity(), event.time(), context.getBroadcastState(DEVICES))
                .filter(device ->
                        device.domain().equals(domain) && device.mission().equals(event.mission()))
                .isPresent();
    }

    private void deleted(ReportedEvent event, ReadOnlyContext context, Collector<ReportedEvent> out) throws Exception {
        List<CachedRoute> ended = routes.allOf(event.type());
        if (ended.isEmpty()) {
            out.collect(completed(event, context));
        }
        for (CachedRoute known : ended) {
            if (Math.min(known.time(), known.received()) <= event.time()) {
                routes.remove(known);
            }
            ReportedEvent deletion = ended.size() > 1 ? event.deletionOf(known.type()) : event;
            out.collect(deletion.belongingTo(known.domain(), known.mission()));
        }
    }

    /** A device's mission belongs to one domain: an event that names another domain does not get it. */
    private ReportedEvent completed(ReportedEvent event, ReadOnlyContext context) throws Exception {
        Optional<DeviceVersion> device = devices.at(event.identity(), event.time(), context.getBroadcastState(DEVICES));
        String domain =
                firstOf(event.domain(), device.map(DeviceVersion::domain).orElse(""), rule.defaultDomain());
        String itsMission = device.filter(version -> version.domain().equals(domain))
                .map(DeviceVersion::mission)
                .orElse("");
        return event.belongingTo(domain, firstOf(event.mission(), itsMission, rule.defaultMission()));
    }

    @Override
    public void processBroadcastElement(DeviceChange change, Context context, Collector<ReportedEvent> out)
            throws Exception {
        devices.note(change, context.getBroadcastState(DEVICES));
    }

    private static String firstOf(String first, String second, String third) {
        if (!first.isEmpty()) {
            return first;
        }
        return second.isEmpty() ? third : second;
    }
}
