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
 * What {@code service.devices} says of every device as of an event's time: the versions in the broadcast state of a
 * function, completed by what was on the topic when the function was opened. The function holds the state, because savepoints
 * know it by the function's own type.
 *
 * @param <H> the form in which the state holds the versions of a device
 */
public final class DeviceLookup<H> implements Serializable {
    private static final long serialVersionUID = 1L;

    private final TopicSnapshot topic;
    private final long keptMillis;
    private final StateCodec<H> form;
    private transient ChangesAtStart atStart;
    private transient boolean compared;
    private transient int changesUntilSweep;

    /** How the state holds the versions of a device. */
    public interface StateCodec<H> extends Serializable {
        DeviceVersions read(H held);

        H held(DeviceVersions versions);
    }

    /**
     * @param topic what is read before the first event
     * @param kept how long versions that ended are kept for events that come late
     */
    public DeviceLookup(TopicSnapshot topic, Duration kept, StateCodec<H> form) {
        this.topic = topic;
        this.keptMillis = kept.toMillis();
        this.form = form;
    }

    /** Reads what is known of devices; to be called before the first event, also after each restart. */
    public void open() throws IOException {
        atStart = new ChangesAtStart();
        compared = false;
        for (TopicRecord record : topic.read()) {
            try {
                atStart.add(RecognizeDevices.read(record));
            } catch (UnreadableException e) { // becomes a dead letter where the stream of devices is read
                continue;
            }
        }
    }

    /** The version that held at an event time. What was read at the start may be newer than a restored state. */
    public Optional<DeviceVersion> at(String identity, long time, ReadOnlyBroadcastState<String, H> state)
            throws Exception {
        if (!compared) {
            forgetWhatIsRestored(state);
        }
        return current(identity, state).at(Epochs.original(time));
    }

    private DeviceVersions current(String identity, ReadOnlyBroadcastState<String, H> state) throws Exception {
        DeviceVersions known = known(state.get(identity));
        for (DeviceChange change : atStart.of(identity)) {
            known = known.with(change);
        }
        return known;
    }

    /** The stream of a restored job begins behind what its state holds: it will not pass that again. */
    private void forgetWhatIsRestored(ReadOnlyBroadcastState<String, H> state) throws Exception {
        Set<String> restored = new HashSet<>();
        for (Map.Entry<String, H> each : state.immutableEntries()) {
            if (current(each.getKey(), state).equals(form.read(each.getValue()))) {
                restored.add(each.getKey());
            }
        }
        atStart.forget(restored::contains);
        compared = true;
    }

    /** How many changes are held beside the state. */
    int heldBesideState() {
        return atStart.size();
    }

    /** Takes a change into the state; forgets versions that ended longer ago than they are kept. */
    public void note(DeviceChange change, BroadcastState<String, H> state) throws Exception {
        state.put(change.key(), form.held(known(state.get(change.key())).with(change)));
        atStart.passed(change);
        if (--changesUntilSweep <= 0) {
            changesUntilSweep = sweep(state, change.time() - keptMillis);
        }
    }

    private DeviceVersions known(H held) {
        return held == null ? DeviceVersions.EMPTY : form.read(held);
    }

    /** As many changes as there are devices lie between two sweeps, so that their cost does not grow with the devices. */
    private int sweep(BroadcastState<String, H> state, long before) throws Exception {
        Map<String, DeviceVersions> changed = new HashMap<>();
        int left = 0;
        for (Map.Entry<String, H> each : state.entries()) {
            DeviceVersions known = form.read(each.getValue());
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
                state.put(each.getKey(), form.held(each.getValue()));
            }
        }
        return left;
    }
}
