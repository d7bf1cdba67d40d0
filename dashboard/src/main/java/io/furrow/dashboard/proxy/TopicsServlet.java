package io.furrow.dashboard.proxy;

import java.io.IOException;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;
import io.furrow.model.ngsi.NgsiJson;

/**
 * {@code GET /api/topics}: the existing topics that may be read, sorted by name, with the number of records written to
 * each; with parameters {@code name}, only these.
 */
public final class TopicsServlet extends UserServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public TopicsServlet(TopicStreams streams) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        ArrayNode topics = NgsiJson.array();
        String[] names = request.getParameterValues("name");
        List<String> readable = names == null
                ? streams.feeds().topics().stream()
                        .filter(streams.rules()::mayRead)
                        .toList()
                : Stream.of(names)
                        .distinct()
                        .filter(streams.rules()::mayRead)
                        .filter(streams.feeds()::exists)
                        .sorted()
                        .toList();
        Map<String, Long> written = streams.feeds().written(readable);
        for (String topic : readable) {
            topics.addObject()
                    .put("name", topic)
                    .put("writable", streams.rules().mayWrite(topic))
                    .put("written", written.getOrDefault(topic, 0L));
        }
        write(topics, response);
    }
}
