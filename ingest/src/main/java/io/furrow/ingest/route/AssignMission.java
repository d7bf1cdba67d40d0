package io.furrow.ingest.route;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.BroadcastState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Says of each event to which domain and mission it belongs: as its attributes say, else as {@code service.devices} said of
 * the entity at the event's time, else as configured. A deletion, which names nothing, goes where the entity's newest event
 * went.
 *
 * <p>State: the newest route per entity; every device's versions, the same at each subtask. Cleared: the route by the
 * deletion, versions when they ended longer ago than they are kept. Late: an event is assigned as of its own time, and does
 * not change the route of a newer one. Emits: every event once.
 */
public final class AssignMission
        extends KeyedBroadcastProcessFunction<String, ReportedEvent, DeviceChange, ReportedEvent> {
    /** The devices, by identity. */
    public static final MapStateDescriptor<String, DeviceHistory> DEVICES =
            new MapStateDescriptor<>("devices", Types.STRING, TypeInformation.of(DeviceHistory.class));

    private static final long serialVersionUID = 1L;

    /**
     * What is configured.
     *
     * @param kept how long versions that ended are kept for events that come late
     * @param defaultDomain empty where there is none, as {@code defaultMission}
     */
    public record Rule(Duration kept, String defaultDomain, String defaultMission) implements Serializable {}

    private final DevicesAtStart devicesAtStart;
    private final Rule rule;
    private transient Map<String, List<DeviceChange>> atStart;
    private transient int changesUntilSweep;
    private transient ValueState<KnownRoute> route;

    public AssignMission(DevicesAtStart devicesAtStart, Rule rule) {
        this.devicesAtStart = devicesAtStart;
        this.rule = rule;
    }

    /** Reads what is known of devices before the first event comes, here and after each restart. */
    @Override
    public void open(OpenContext context) throws IOException {
        route = getRuntimeContext().getState(new ValueStateDescriptor<>("route", TypeInformation.of(KnownRoute.class)));
        atStart = new HashMap<>();
        for (TopicRecord record : devicesAtStart.read()) {
            try {
                DeviceChange change = ReadDevices.read(record);
                atStart.computeIfAbsent(change.key(), key -> new ArrayList<>()).add(change);
            } catch (UnreadableException e) { // becomes a dead letter where the stream of devices is read
                continue;
            }
        }
    }

    @Override
    public void processElement(ReportedEvent event, ReadOnlyContext context, Collector<ReportedEvent> out)
            throws Exception {
        out.collect(event.isDeletion() ? deleted(event, context) : assigned(event, context));
    }

    private ReportedEvent assigned(ReportedEvent event, ReadOnlyContext context) throws Exception {
        ReportedEvent assigned =
                event.domain().isEmpty() || event.mission().isEmpty() ? completed(event, context) : event;
        KnownRoute known = route.value();
        if (known == null || known.time() <= event.time()) {
            route.update(new KnownRoute(assigned.domain(), assigned.mission(), event.time()));
        }
        return assigned;
    }

    private ReportedEvent deleted(ReportedEvent event, ReadOnlyContext context) throws Exception {
        KnownRoute known = route.value();
        if (known != null && known.time() <= event.time()) {
            route.clear();
        }
        return known == null ? completed(event, context) : event.belongingTo(known.domain(), known.mission());
    }

    /** A mission that is known of a device is one of its domain: an event that names another domain does not get it. */
    private ReportedEvent completed(ReportedEvent event, ReadOnlyContext context) throws Exception {
        Optional<DeviceVersion> device = deviceOf(event, context);
        String domain =
                firstOf(event.domain(), device.map(DeviceVersion::domain).orElse(""), rule.defaultDomain());
        String itsMission = device.filter(version -> version.domain().equals(domain))
                .map(DeviceVersion::mission)
                .orElse("");
        return event.belongingTo(domain, firstOf(event.mission(), itsMission, rule.defaultMission()));
    }

    /** What was read at the start may be newer than the state that the job was restored from. */
    private Optional<DeviceVersion> deviceOf(ReportedEvent event, ReadOnlyContext context) throws Exception {
        DeviceHistory history = context.getBroadcastState(DEVICES).get(event.identity());
        DeviceHistory known = history == null ? DeviceHistory.EMPTY : history;
        for (DeviceChange change : atStart.getOrDefault(event.identity(), List.of())) {
            known = known.with(change);
        }
        return known.at(event.time());
    }

    @Override
    public void processBroadcastElement(DeviceChange change, Context context, Collector<ReportedEvent> out)
            throws Exception {
        BroadcastState<String, DeviceHistory> devices = context.getBroadcastState(DEVICES);
        DeviceHistory known = devices.get(change.key());
        devices.put(change.key(), (known == null ? DeviceHistory.EMPTY : known).with(change));
        atStart.computeIfPresent(change.key(), (key, changes) -> later(changes, change.offset()));
        if (--changesUntilSweep <= 0) {
            changesUntilSweep = sweep(devices, change.time() - rule.kept().toMillis());
        }
    }

    /** Null where none is left, which takes the entry from the map. */
    private static List<DeviceChange> later(List<DeviceChange> changes, long offset) {
        List<DeviceChange> later =
                changes.stream().filter(change -> change.offset() > offset).toList();
        return later.isEmpty() ? null : later;
    }

    /** As many changes as there are devices lie between two sweeps, so that their cost does not grow with the devices. */
    private static int sweep(BroadcastState<String, DeviceHistory> devices, long before) throws Exception {
        Map<String, DeviceHistory> changed = new HashMap<>();
        int left = 0;
        for (Map.Entry<String, DeviceHistory> each : devices.entries()) {
            DeviceHistory kept = each.getValue().since(before);
            if (kept.isEmpty() || kept != each.getValue()) {
                changed.put(each.getKey(), kept);
            }
            left += kept.isEmpty() ? 0 : 1;
        }
        for (Map.Entry<String, DeviceHistory> each : changed.entrySet()) {
            if (each.getValue().isEmpty()) {
                devices.remove(each.getKey());
            } else {
                devices.put(each.getKey(), each.getValue());
            }
        }
        return left;
    }

    private static String firstOf(String first, String second, String third) {
        if (!first.isEmpty()) {
            return first;
        }
        return second.isEmpty() ? third : second;
    }
}
