package io.furrow.control.replay;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.RecordedMission;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class RecordingListTest {
    private static final long NOW = 1_000_000;

    private final RecordingList list = new RecordingList();
    private final Map<String, Optional<RecordedMission>> stored = new TreeMap<>();
    private final List<String> polled = new ArrayList<>();
    private boolean unavailable;

    /** Applies the changes to the topic and returns them. */
    private Map<String, Optional<RecordedMission>> poll(long now) throws IOException {
        polled.clear();
        Map<String, Optional<RecordedMission>> changes = list.changes(
                new RecordingList.Store() {
                    @Override
                    public List<String> names() throws IOException {
                        if (unavailable) {
                            throw new IOException("MongoDB is away");
                        }
                        return List.copyOf(stored.keySet());
                    }

                    @Override
                    public Optional<RecordedMission> find(String name) {
                        polled.add(name);
                        return stored.get(name);
                    }
                },
                now);
        changes.forEach((mission, found) ->
                list.take(mission, found.map(RecordedMission::toBytes).orElse(null), now));
        return changes;
    }

    private RecordedMission store(String mission, long first, long last) {
        RecordedMission recorded = new RecordedMission(mission, first, last, 5);
        stored.put(mission, Optional.of(recorded));
        return recorded;
    }

    @Test
    void listsANewMissionImmediatelyAndChangesAfterHalfAMinute() throws Exception {
        RecordedMission short1 = store("m", 10, 20);
        assertThat(poll(NOW)).containsExactly(Map.entry("m", Optional.of(short1)));
        RecordedMission longer = store("m", 10, 30);
        assertThat(poll(NOW + 29_999)).isEmpty();
        assertThat(polled).isEmpty();
        assertThat(poll(NOW + 30_000)).containsExactly(Map.entry("m", Optional.of(longer)));
        assertThat(poll(NOW + 60_000)).as("nothing has changed").isEmpty();
        assertThat(polled).containsExactly("m");
    }

    @Test
    void pollsAMissionUntilItHasEvents() throws Exception {
        stored.put("m", Optional.empty());
        assertThat(poll(NOW)).isEmpty();
        RecordedMission begun = store("m", 10, 10);
        assertThat(poll(NOW + 2000)).containsExactly(Map.entry("m", Optional.of(begun)));
    }

    @Test
    void removesADeletedMissionAndListsItAgainIfRecreated() throws Exception {
        RecordedMission first = store("m", 10, 20);
        poll(NOW);
        stored.clear();
        assertThat(poll(NOW + 2000)).containsExactly(Map.entry("m", Optional.empty()));
        assertThat(poll(NOW + 4000)).isEmpty();
        stored.put("m", Optional.of(first));
        assertThat(poll(NOW + 6000)).containsExactly(Map.entry("m", Optional.of(first)));
    }

    @Test
    void skipsMissionsThatAnotherInstanceHasPolled() throws Exception {
        list.take("m", store("m", 10, 20).toBytes(), NOW);
        store("m", 10, 30);
        assertThat(poll(NOW + 20_000)).isEmpty();
        assertThat(polled).isEmpty();
        assertThat(poll(NOW + 30_000)).hasSize(1);
    }

    @Test
    void retainsTheListWhileMongoDbIsUnavailable() throws Exception {
        store("m", 10, 20);
        poll(NOW);
        unavailable = true;
        assertThatThrownBy(() -> poll(NOW + 60_000)).isInstanceOf(IOException.class);
        assertThat(list.size()).isEqualTo(1);
        unavailable = false;
        assertThat(poll(NOW + 61_000)).isEmpty();
    }

    @Test
    void replacesUnreadableRecords() throws Exception {
        list.take("m", new byte[] {1}, NOW);
        RecordedMission recorded = store("m", 10, 20);
        assertThat(poll(NOW)).containsExactly(Map.entry("m", Optional.of(recorded)));
    }
}
