package io.furrow.dashboard.proxy;

import java.io.IOException;

import jakarta.servlet.AsyncContext;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.auth.UserServlet;

/** {@code GET /api/stream/<topic>}: a topic as server-sent events; each event is a frame of records. */
public final class StreamServlet extends UserServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public StreamServlet(TopicStreams streams) {
        super(streams.users(), streams.counters()::rejected);
        this.streams = streams;
    }

    @Override
    protected void answer(HttpServletRequest request, HttpServletResponse response, User user) throws IOException {
        Credentials credentials = Credentials.of(request);
        StreamRequest stream = StreamRequest.read(request, streams.rules(), StreamRequest.Format.RECORD);
        streams.feeds().check(stream.topic());
        streams.acquire(credentials.client());
        response.setContentType("text/event-stream");
        response.setCharacterEncoding("UTF-8");
        response.setHeader("Cache-Control", "no-store");
        AsyncContext context = request.startAsync();
        context.setTimeout(0);
        SendQueue queue = new SendQueue(stream, streams.limits(), streams.counters());
        EventStream events = new EventStream(streams, stream.topic(), credentials, context, queue);
        response.getOutputStream().setWriteListener(events);
        context.addListener(events);
        streams.begin(stream, events, queue);
    }
}
