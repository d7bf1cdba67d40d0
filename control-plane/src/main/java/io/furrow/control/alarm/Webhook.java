package io.furrow.control.alarm;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Clock;
import java.time.Duration;
import java.util.EnumSet;
import java.util.Set;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Posts alarms that were opened, acknowledged, closed or are no longer muted to a URL, as JSON: the record of {@code
 * service.alarms} with {@code id}, the same however often it is posted. What the other side does not take (no answer, 408, 429,
 * 5xx) is tried again after longer and longer pauses, then given up and said in the log; what it refuses is not tried again.
 */
public final class Webhook implements AlarmFollower.Action {
    private static final Logger LOG = LoggerFactory.getLogger(Webhook.class);
    private static final Set<Alarm.Change> TOLD = EnumSet.complementOf(EnumSet.of(Alarm.Change.MUTED));
    private static final Duration PATIENCE = Duration.ofSeconds(10);

    private final Settings settings;
    private final Clock clock;
    private final HttpClient client =
            HttpClient.newBuilder().connectTimeout(PATIENCE).build();

    /**
     * Where to post to. The URL may hold a secret: it is not logged but for its host.
     *
     * @param attempts how often an alarm is posted before it is given up
     * @param pause before the second attempt; doubled before each further one
     */
    public record Settings(URI url, int attempts, Duration pause) {
        /** Eight attempts within some two minutes. */
        public static Settings of(URI url) {
            return new Settings(url, 8, Duration.ofSeconds(1));
        }
    }

    Webhook(Settings settings, Clock clock) {
        this.settings = settings;
        this.clock = clock;
    }

    @Override
    public void take(Alarm alarm) throws InterruptedException {
        if (!TOLD.contains(alarm.change()) || alarm.isMuted(clock.millis())) {
            return;
        }
        Duration pause = settings.pause();
        String failure = null;
        for (int attempt = 1; attempt <= settings.attempts(); attempt++) {
            if (attempt > 1) {
                Thread.sleep(pause.toMillis());
                pause = pause.multipliedBy(2);
            }
            int status;
            try {
                status = post(alarm);
            } catch (IOException e) {
                failure = e.toString();
                continue;
            }
            if (status / 100 == 2) {
                return;
            }
            failure = "it answers " + status;
            if (status != 408 && status != 429 && status / 100 != 5) {
                break;
            }
        }
        LOG.error(
                "the webhook at {} was not told of alarm {}, {}: {}",
                settings.url().getHost(),
                alarm.alarm(),
                alarm.change().word(),
                failure);
    }

    private int post(Alarm alarm) throws IOException, InterruptedException {
        HttpRequest request = HttpRequest.newBuilder(settings.url())
                .timeout(PATIENCE)
                .header("Content-Type", "application/json")
                .POST(HttpRequest.BodyPublishers.ofByteArray(body(alarm)))
                .build();
        return client.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
    }

    private static byte[] body(Alarm alarm) {
        try {
            ObjectNode json = NgsiJson.mapper().createObjectNode();
            json.put("id", "%s:%d".formatted(alarm.alarm(), alarm.sequence()));
            json.setAll((ObjectNode) NgsiJson.read(alarm.toBytes()));
            return NgsiJson.write(json);
        } catch (UnreadableException e) {
            throw new IllegalStateException("an alarm is not read as it was written", e);
        }
    }
}
