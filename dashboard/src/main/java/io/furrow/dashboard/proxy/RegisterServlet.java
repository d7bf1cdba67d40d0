package io.furrow.dashboard.proxy;

import java.io.IOException;

import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;
import io.furrow.model.ngsi.NgsiJson;

/** {@code GET /api/register/<topic>}: the path of a socket, which may be opened once. */
public final class RegisterServlet extends UserServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public RegisterServlet(TopicStreams streams) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        Credentials credentials = Credentials.of(request);
        StreamRequest stream = StreamRequest.read(request, streams.rules(), StreamRequest.Format.VALUE);
        streams.feeds().check(stream.topic());
        String ticket = streams.tickets().issue(stream, user, credentials);
        write(NgsiJson.object().put("socket", "/socket/" + ticket), response);
    }
}
