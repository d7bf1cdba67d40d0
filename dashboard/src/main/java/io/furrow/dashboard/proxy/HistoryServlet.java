package io.furrow.dashboard.proxy;

import java.io.IOException;
import java.io.Writer;
import java.util.Properties;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;

import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;
import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;
import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.TopicHistory;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.text.FailureText;

/**
 * {@code GET /api/history/<topic>}: the records of a topic in a period. At most {@value #MAX_CONCURRENT} requests run
 * at once.
 */
public final class HistoryServlet extends UserServlet {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(HistoryServlet.class);
    private static final int MAX_CONCURRENT = 4;
    private static final int WAIT_SECONDS = 5;
    private static final int MAX_RECORDS = 5_000;
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_]{1,64}");

    private final transient TopicStreams streams;
    private final transient TopicHistory history;
    private final transient Semaphore free = new Semaphore(MAX_CONCURRENT);

    public HistoryServlet(TopicStreams streams, Properties client) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
        this.history = new TopicHistory(
                client, TopicHistory.Limits.DEFAULT, streams.limits().valueBytes());
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        String topic = StreamRequest.topic(request, streams.rules());
        long now = System.currentTimeMillis();
        long from = StreamRequest.number(request, "from", 0, Long.MAX_VALUE / 2, null);
        long to = StreamRequest.number(request, "to", from, Long.MAX_VALUE / 2, Math.max(from, now + 1));
        int limit = (int) StreamRequest.number(request, "limit", 1, MAX_RECORDS, (long) MAX_RECORDS);
        TopicHistory.Range range = new TopicHistory.Range(topic, from, to, newest(request), limit);
        streams.feeds().check(topic);
        write(read(range), response);
    }

    private TopicHistory.Answer read(TopicHistory.Range range) {
        try {
            if (!free.tryAcquire(WAIT_SECONDS, TimeUnit.SECONDS)) {
                throw new Problem(
                        503,
                        "overloaded",
                        "%d histories are being read; try again in a moment".formatted(MAX_CONCURRENT));
            }
        } catch (InterruptedException e) {
            throw Problem.stopping();
        }
        try {
            return history.read(range);
        } catch (KafkaException e) {
            LOG.warn("the history of topic {} cannot be read", range.topic(), e);
            throw new Problem(
                    503,
                    "kafka-away",
                    "topic '%s' cannot be read (%s); check --kafka and that it runs"
                            .formatted(range.topic(), FailureText.of(e)));
        } finally {
            free.release();
        }
    }

    private static void write(TopicHistory.Answer answer, HttpServletResponse response) throws IOException {
        response.setContentType("application/json");
        response.setCharacterEncoding("UTF-8");
        response.setHeader("Cache-Control", "no-store");
        try (Writer out = response.getWriter()) {
            out.write("{\"since\":" + answer.since() + ",\"records\":[");
            String separator = "";
            for (FeedRecord record : answer.records()) {
                out.write(separator);
                out.write(record.envelope());
                separator = ",";
            }
            out.write("]}");
        }
    }

    private static String newest(HttpServletRequest request) {
        String name = request.getParameter("newest");
        if (name != null && !NAME.matcher(name).matches()) {
            throw new Problem(400, "wrong-parameter", "'newest' must be the name of an attribute");
        }
        return name;
    }
}
