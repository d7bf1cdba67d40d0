package io.furrow.cli.control;

import java.io.UncheckedIOException;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.cli.control.client.ControlTransfer;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Follows a replay by the server-sent events of the control plane, on its own thread, until the event {@code over}; reconnects after
 * a lost connection. A control plane without events is polled every second.
 */
final class ReplayEvents implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ReplayEvents.class);
    private static final long RETRY_SECONDS = 1;

    private final ControlApi api;
    private final String path;
    private final CountDownLatch closed = new CountDownLatch(1);
    private final Thread thread = new Thread(this::run, "replay-events");
    private volatile JsonNode newest;
    private volatile boolean connected;
    private volatile boolean over;
    private String event = "";
    private final StringBuilder data = new StringBuilder();

    /**
     * @param path of the replay
     * @param first its state before the first event
     */
    ReplayEvents(ControlApi api, String path, JsonNode first) {
        this.api = api;
        this.path = path;
        this.newest = first;
        thread.setDaemon(true);
    }

    void start() {
        thread.start();
    }

    /** The replay as of the newest event. */
    JsonNode newest() {
        return newest;
    }

    boolean isConnected() {
        return connected;
    }

    boolean isOver() {
        return over;
    }

    private void run() {
        try {
            while (!over && closed.getCount() > 0) {
                read();
                if (!over && closed.await(RETRY_SECONDS, TimeUnit.SECONDS)) {
                    return;
                }
            }
        } catch (InterruptedException e) {
            LOG.debug("closed", e);
        }
    }

    private void read() {
        try (Stream<String> lines = new ControlTransfer(api).events(path + "/events")) {
            connected = true;
            event = "";
            data.setLength(0);
            lines.takeWhile(line -> closed.getCount() > 0 && !over).forEach(this::line);
            connected = false;
        } catch (ControlPlaneException e) {
            LOG.debug("{} cannot be followed now", path, e);
            connected = false;
            if (e.isUnknown()) {
                request();
            }
        } catch (UncheckedIOException e) {
            LOG.debug("the connection to {} is lost", path, e);
            connected = false;
        }
    }

    /** Polls a control plane without events; an unknown replay is over. */
    private void request() {
        try {
            newest = api.get(path);
            connected = true;
        } catch (ControlPlaneException e) {
            LOG.debug("{} cannot be polled now", path, e);
            over = e.isUnknown();
        }
    }

    /** A line of {@code text/event-stream}; an empty one ends an event. */
    void line(String line) {
        if (line.startsWith("event:")) {
            event = line.substring("event:".length()).trim();
        } else if (line.startsWith("data:")) {
            data.append(line.substring("data:".length()).trim());
        } else if (line.isEmpty()) {
            end();
        }
    }

    private void end() {
        if (!data.isEmpty()) {
            try {
                JsonNode json = NgsiJson.read(data.toString().getBytes(UTF_8));
                if (json.has("replay")) {
                    newest = json;
                }
            } catch (UnreadableException e) {
                LOG.debug("skipped an event of {}", path, e);
            }
        }
        over = over || event.equals("over");
        event = "";
        data.setLength(0);
    }

    @Override
    public void close() {
        closed.countDown();
        thread.interrupt();
    }
}
