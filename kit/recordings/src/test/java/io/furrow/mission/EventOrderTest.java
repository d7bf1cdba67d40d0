package io.furrow.mission;

import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class EventOrderTest {
    @Test
    void ordersTheEventsOfOneMillisecondById() {
        assertThat(ids(EventOrder.within(events("1c", "1a", "1b", "2b", "3z", "3y"))))
                .containsExactly("1a", "1b", "1c", "2b", "3y", "3z");
        assertThat(ids(EventOrder.within(events()))).isEmpty();
    }

    @Test
    void mergesOrderedSequences() {
        assertThat(ids(EventOrder.merged(List.of(events("1a", "3a"), events(), events("1b", "2a", "4a")))))
                .containsExactly("1a", "1b", "2a", "3a", "4a");
    }

    /** Creates events from ids of a digit, the time, and a letter. */
    private static Iterator<StoredEvent> events(String... ids) {
        List<StoredEvent> events = new ArrayList<>();
        for (String id : ids) {
            events.add(new StoredEvent(id, id.charAt(0) - '0', "t", Map.of(), null));
        }
        return events.iterator();
    }

    private static List<String> ids(Iterator<StoredEvent> events) {
        List<String> ids = new ArrayList<>();
        events.forEachRemaining(event -> ids.add(event.id()));
        return ids;
    }
}
