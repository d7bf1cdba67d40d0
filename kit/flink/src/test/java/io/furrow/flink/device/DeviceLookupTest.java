package io.furrow.flink.device;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.Iterator;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.state.BroadcastState;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class DeviceLookupTest {
    private final List<TopicRecord> topic = new ArrayList<>();
    private final Held state = new Held();

    @Test
    void holdsNoSecondCopyOnceTheStreamHasPassedTheTopic() throws Exception {
        devices(0, 10);
        DeviceLookup book = book();
        assertThat(mission(book, 3)).isEqualTo("m1");
        assertThat(book.heldBesideState()).isEqualTo(10);

        pass(book, 0, 10);

        assertThat(book.heldBesideState()).isZero();
        assertThat(mission(book, 3)).isEqualTo("m1");
    }

    @Test
    void holdsNoSecondCopyOfWhatWasRestored() throws Exception {
        devices(0, 10);
        pass(book(), 0, 10);
        topic.add(record(3, 2, 10)); // since the savepoint
        DeviceLookup restored = book();

        assertThat(mission(restored, 4)).isEqualTo("m1");
        assertThat(mission(restored, 3)).isEqualTo("m2");
        assertThat(restored.heldBesideState())
                .as("of the device that has changed since")
                .isEqualTo(2);

        pass(restored, 10, 11);
        assertThat(restored.heldBesideState()).isZero();
        assertThat(mission(restored, 3)).isEqualTo("m2");
    }

    @Test
    void holdsNothingThatTheRestoredStreamIsBehind() throws Exception {
        devices(0, 10);
        topic.add(record(20, 1, 10));
        DeviceLookup restored = book(); // whose state has forgotten devices that ended long ago

        pass(restored, 10, 11);

        assertThat(restored.heldBesideState()).isZero();
    }

    private DeviceLookup book() throws Exception {
        List<TopicRecord> now = List.copyOf(topic);
        DeviceLookup book = new DeviceLookup(() -> now, Duration.ofDays(1));
        book.open();
        return book;
    }

    private void devices(int from, int to) {
        for (int number = from; number < to; number++) {
            topic.add(record(number, 1, number));
        }
    }

    /** The stream from an offset to another. */
    private void pass(DeviceLookup book, int from, int to) throws Exception {
        for (TopicRecord record : topic.subList(from, to)) {
            book.note(ParseDevices.read(record), state);
        }
    }

    private String mission(DeviceLookup book, int device) throws Exception {
        return book.at("|/|r" + device, 500, state).orElseThrow().mission();
    }

    private static TopicRecord record(int device, int sequence, long offset) {
        DeviceVersion version =
                new DeviceVersion("r" + device, "", "/", "d", "m" + sequence, 100L * sequence, null, sequence, null);
        return new TopicRecord(Topics.DEVICES, 0, offset, 0, new byte[0], version.toBytes(), Map.of());
    }

    private static final class Held implements BroadcastState<String, DeviceVersions> {
        private final Map<String, DeviceVersions> map = new HashMap<>();

        @Override
        public void put(String key, DeviceVersions value) {
            map.put(key, value);
        }

        @Override
        public void putAll(Map<String, DeviceVersions> all) {
            map.putAll(all);
        }

        @Override
        public void remove(String key) {
            map.remove(key);
        }

        @Override
        public Iterator<Map.Entry<String, DeviceVersions>> iterator() {
            return map.entrySet().iterator();
        }

        @Override
        public Iterable<Map.Entry<String, DeviceVersions>> entries() {
            return map.entrySet();
        }

        @Override
        public DeviceVersions get(String key) {
            return map.get(key);
        }

        @Override
        public boolean contains(String key) {
            return map.containsKey(key);
        }

        @Override
        public Iterable<Map.Entry<String, DeviceVersions>> immutableEntries() {
            return map.entrySet();
        }

        @Override
        public void clear() {
            map.clear();
        }
    }
}
