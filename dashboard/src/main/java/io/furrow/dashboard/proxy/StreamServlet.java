package io.furrow.dashboard.proxy;

import java.io.IOException;

import jakarta.servlet.AsyncContext;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.http.Problem;

/** {@code GET /api/stream/<topic>}: a topic as server-sent events, each with the records of a frame. */
public final class StreamServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final transient TopicStreams streams;

    public StreamServlet(TopicStreams streams) {
        this.streams = streams;
    }

    @Override
    protected void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            Credentials credentials = Credentials.of(request);
            streams.users().find(credentials);
            StreamRequest desired = StreamRequest.read(request, streams.rules(), StreamRequest.Format.RECORD);
            streams.feeds().check(desired.topic());
            streams.take(credentials.client());
            response.setContentType("text/event-stream");
            response.setCharacterEncoding("UTF-8");
            response.setHeader("Cache-Control", "no-store");
            AsyncContext context = request.startAsync();
            context.setTimeout(0);
            SendQueue queue = new SendQueue(desired, streams.limits(), streams.counters());
            EventStream stream = new EventStream(streams, desired.topic(), credentials, context, queue);
            response.getOutputStream().setWriteListener(stream);
            context.addListener(stream);
            streams.begin(desired, stream, queue);
        } catch (Problem problem) {
            streams.counters().refused(problem);
            problem.answer(response);
        }
    }
}
