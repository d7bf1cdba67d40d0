package io.furrow.dashboard.proxy;

import java.io.IOException;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeoutException;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;
import org.apache.kafka.clients.admin.Admin;

import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;
import io.furrow.dashboard.feed.TopicDensity;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** {@code GET /api/density/<topic>?from&to&width}: the number of records of a topic per bucket; times in epoch ms. */
public final class DensityServlet extends UserServlet {
    private static final long serialVersionUID = 1L;
    private static final long DAY = 86_400_000;

    private final transient TopicStreams streams;
    private final transient TopicDensity density;

    public DensityServlet(TopicStreams streams, Admin admin) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
        this.density = new TopicDensity(admin);
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        String topic = StreamRequest.topic(request, streams.rules());
        long width = StreamRequest.number(request, "width", 100, DAY, null);
        long from = Math.floorDiv(StreamRequest.number(request, "from", 0, Long.MAX_VALUE / 4, null), width) * width;
        long to = StreamRequest.number(request, "to", from, Long.MAX_VALUE / 2, null);
        if (to - from > TopicDensity.MAX_BUCKETS * width) {
            throw new Problem(
                    400,
                    "wrong-parameter",
                    "there are at most %d buckets: 'to' must be at most %d, or 'width' greater"
                            .formatted(TopicDensity.MAX_BUCKETS, from + TopicDensity.MAX_BUCKETS * width));
        }
        streams.feeds().check(topic);
        write(topic, from, width, Math.toIntExact(-Math.floorDiv(from - to, width)), response);
    }

    private void write(String topic, long from, long width, int buckets, HttpServletResponse response)
            throws IOException {
        ObjectNode answer = NgsiJson.object().put("from", from).put("width", width);
        ArrayNode counts = answer.putArray("counts");
        try {
            density.count(topic, from, width, buckets).forEach(counts::add);
        } catch (ExecutionException | TimeoutException e) {
            Throwable cause = e instanceof ExecutionException ? e.getCause() : e;
            throw new Problem(
                    503,
                    "kafka-away",
                    "the times of topic '%s' cannot be read (%s); check --kafka and that it runs"
                            .formatted(
                                    topic,
                                    cause instanceof TimeoutException
                                            ? "no answer within 15 s"
                                            : FailureText.of(cause)));
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
        write(answer, response);
    }
}
