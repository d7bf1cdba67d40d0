package io.furrow.dashboard.proxy;

import java.io.IOException;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;

/** {@code GET /api/topics}: the topics that there are and may be read, by name, and how many records were written to each. */
public final class TopicsServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public TopicsServlet(TopicStreams streams) {
        this.streams = streams;
    }

    @Override
    protected void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            streams.users().find(Credentials.of(request));
            ArrayNode topics = JsonNodeFactory.instance.arrayNode();
            List<String> readable = streams.feeds().topics().stream()
                    .filter(streams.rules()::mayRead)
                    .toList();
            Map<String, Long> written = streams.feeds().written(readable);
            for (String topic : readable) {
                topics.addObject()
                        .put("name", topic)
                        .put("writable", streams.rules().mayWrite(topic))
                        .put("written", written.getOrDefault(topic, 0L));
            }
            response.setContentType("application/json");
            response.setHeader("Cache-Control", "no-store");
            response.getOutputStream().write(NgsiJson.write(topics));
        } catch (Problem problem) {
            streams.counters().refused(problem);
            problem.answer(response);
        }
    }
}
