package io.furrow.suite.page;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** A tab that nobody sees. What it costs is measured by {@code ./furrow soak page --only hidden}. */
@PageTest
@Tag("full")
class HiddenIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";

    @Test
    void letsGoOfEverythingAndComesBack(PageSuite suite) {
        FarmPage hidden = suite.window();
        AtomicInteger sockets = new AtomicInteger();
        List<String> requests = new CopyOnWriteArrayList<>();
        hidden.page().onRequest(request -> requests.add(request.url()));
        hidden.page().onWebSocket(socket -> {
            sockets.incrementAndGet();
            socket.onFrameReceived(frame -> requests.add(frame.text()));
            socket.onClose(closed -> sockets.decrementAndGet());
        });
        hidden.open("");
        hidden.untilStore("store.primed");
        assertThat(sockets).hasPositiveValue();
        FarmPage seen = suite.open("");
        seen.untilStore("store.primed");

        hidden.hide();
        hidden.page().waitForCondition(() -> sockets.get() == 0, FarmPage.TIMEOUT);
        later(seen, 1_000); // what was under way ends
        hidden.page().evaluate("1"); // delivers the events that waited
        requests.clear();
        later(seen, 5_000);
        hidden.page().evaluate("1");
        assertThat(requests).isEmpty();

        hidden.show();
        later(hidden, 0);
        assertThat(sockets).hasPositiveValue();
    }

    /** Until a device reported so many milliseconds from now. */
    private static void later(FarmPage farm, long millis) {
        farm.untilStore("store.entities.get('" + ROBOT + "').time > " + (System.currentTimeMillis() + millis));
    }
}
