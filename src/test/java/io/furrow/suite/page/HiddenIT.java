package io.furrow.suite.page;

import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicInteger;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** A hidden tab. {@code ./furrow soak page --only hidden} measures its cost. */
@PageTest
@Tag("full")
class HiddenIT {
    private static final String ROBOT = "urn:ngsi-ld:Robot:1";

    @Test
    void closesItsStreamsAndReconnects(PageSuite suite) {
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
        FarmPage visible = suite.open("");
        visible.untilStore("store.primed");

        hidden.hide();
        hidden.page().waitForCondition(() -> sockets.get() == 0, FarmPage.TIMEOUT);
        awaitReport(visible, 1_000); // pending requests end
        hidden.page().evaluate("1"); // delivers pending events
        requests.clear();
        awaitReport(visible, 5_000);
        hidden.page().evaluate("1");
        assertThat(requests).isEmpty();

        hidden.show();
        awaitReport(hidden, 0);
        assertThat(sockets).hasPositiveValue();
    }

    /** Waits for a device's report that is at least this much later than now. */
    private static void awaitReport(FarmPage farm, long millis) {
        farm.untilStore("store.entities.get('" + ROBOT + "').time > " + (System.currentTimeMillis() + millis));
    }
}
