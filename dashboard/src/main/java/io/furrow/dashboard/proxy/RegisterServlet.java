package io.furrow.dashboard.proxy;

import java.io.IOException;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;

/** {@code GET /api/register/<topic>}: the path of a socket that may be opened once. */
public final class RegisterServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public RegisterServlet(TopicStreams streams) {
        this.streams = streams;
    }

    @Override
    protected void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            Credentials credentials = Credentials.of(request);
            User user = streams.users().find(credentials);
            StreamRequest desired = StreamRequest.read(request, streams.rules(), StreamRequest.Format.VALUE);
            streams.feeds().check(desired.topic());
            String ticket = streams.tickets().issue(desired, user, credentials);
            response.setContentType("application/json");
            response.setHeader("Cache-Control", "no-store");
            response.getOutputStream()
                    .write(NgsiJson.write(JsonNodeFactory.instance.objectNode().put("socket", "/socket/" + ticket)));
        } catch (Problem problem) {
            streams.counters().refused(problem);
            problem.answer(response);
        }
    }
}
