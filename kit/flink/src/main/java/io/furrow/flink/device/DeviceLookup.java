package io.furrow.flink.device;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.apache.flink.api.common.state.BroadcastState;
import org.apache.flink.api.common.state.ReadOnlyBroadcastState;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Looks up the versions of devices on {@code service.devices} as of an event's time: those in the broadcast state of a
 * function, completed by those read when the function was opened. The function holds the state.
 */
public final class DeviceLookup implements Serializable {
    private static final long serialVersionUID = 1L;

    private final TopicSnapshot topic;
    private final long keptMillis;
    private transient InitialDeviceChanges atStart;
    private transient boolean compared;
    private transient int changesUntilSweep;

    /**
     * @param topic read before the first event
     * @param kept how long ended versions are retained for late events
     */
    public DeviceLookup(TopicSnapshot topic, Duration kept) {
        this.topic = topic;
        this.keptMillis = kept.toMillis();
    }

    /** Reads the existing versions; must be called before the first event, also after each restart. */
    public void open() throws IOException {
        atStart = new InitialDeviceChanges();
        compared = false;
        for (TopicRecord record : topic.read()) {
            try {
                atStart.add(ParseDevices.read(record));
            } catch (UnreadableException e) { // ParseDevices emits its dead letter
                continue;
            }
        }
    }

    /** The version valid at an event time. Versions read at the start may be newer than a restored state. */
    public Optional<DeviceVersion> at(String identity, long time, ReadOnlyBroadcastState<String, DeviceVersions> state)
            throws Exception {
        if (!compared) {
            forgetWhatIsRestored(state);
        }
        return current(identity, state).at(Epochs.original(time));
    }

    private DeviceVersions current(String identity, ReadOnlyBroadcastState<String, DeviceVersions> state)
            throws Exception {
        DeviceVersions known = known(state.get(identity));
        for (DeviceChange change : atStart.of(identity)) {
            known = known.with(change);
        }
        return known;
    }

    /** The stream of a restored job begins after the records in its state: it will not pass those again. */
    private void forgetWhatIsRestored(ReadOnlyBroadcastState<String, DeviceVersions> state) throws Exception {
        Set<String> restored = new HashSet<>();
        for (Map.Entry<String, DeviceVersions> each : state.immutableEntries()) {
            if (current(each.getKey(), state).equals(each.getValue())) {
                restored.add(each.getKey());
            }
        }
        atStart.forget(restored::contains);
        compared = true;
    }

    /** The number of changes held besides the state. */
    int heldBesideState() {
        return atStart.size();
    }

    /** Adds a change to the state; removes versions that ended before the retention. */
    public void note(DeviceChange change, BroadcastState<String, DeviceVersions> state) throws Exception {
        state.put(change.key(), known(state.get(change.key())).with(change));
        atStart.passed(change);
        if (--changesUntilSweep <= 0) {
            changesUntilSweep = sweep(state, change.time() - keptMillis);
        }
    }

    private static DeviceVersions known(DeviceVersions held) {
        return held == null ? DeviceVersions.EMPTY : held;
    }

    /** Sweeps once per as many changes as there are devices, so that the cost per change does not grow with the devices. */
    private int sweep(BroadcastState<String, DeviceVersions> state, long before) throws Exception {
        Map<String, DeviceVersions> changed = new HashMap<>();
        int left = 0;
        for (Map.Entry<String, DeviceVersions> each : state.entries()) {
            DeviceVersions known = each.getValue();
            DeviceVersions kept = known.since(before);
            if (kept.isEmpty() || kept.versions().size() != known.versions().size()) {
                changed.put(each.getKey(), kept);
            }
            left += kept.isEmpty() ? 0 : 1;
        }
        for (Map.Entry<String, DeviceVersions> each : changed.entrySet()) {
            if (each.getValue().isEmpty()) {
                state.remove(each.getKey());
            } else {
                state.put(each.getKey(), each.getValue());
            }
        }
        return left;
    }
}
