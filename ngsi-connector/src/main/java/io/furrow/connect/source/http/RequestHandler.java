package io.furrow.connect.source.http;

import java.util.Optional;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.handler.gzip.GzipHandler;
import org.eclipse.jetty.util.Callback;

/**
 * Routes {@code POST} requests of authenticated senders on any path, inflated, to the notification handler, and all
 * other methods to the pages.
 */
public final class RequestHandler extends Handler.Wrapper {
    private static final int INFLATE_BUFFER = 16 * 1024;

    private final RequestAuthenticator authenticator;
    private final Handler notifications;
    private final StatusHandler pages;
    private final int maxBody;

    /** @param maxBody bytes of a body that is read although its sender is rejected */
    public RequestHandler(RequestAuthenticator authenticator, Handler notifications, StatusHandler pages, int maxBody) {
        super(inflating(notifications));
        this.authenticator = authenticator;
        this.notifications = notifications;
        this.pages = pages;
        this.maxBody = maxBody;
    }

    /** Inflates the body in chunks as it is read: a body that is too long is not inflated to its end. */
    private static Handler inflating(Handler notifications) {
        GzipHandler gzip = new GzipHandler();
        gzip.setInflateBufferSize(INFLATE_BUFFER);
        gzip.setHandler(notifications);
        return gzip;
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) throws Exception {
        if (!HttpMethod.POST.is(request.getMethod())) {
            return pages.handle(request, response, callback);
        }
        Optional<NotificationResponse> refused =
                authenticator.refuse(request.getHeaders()::get).or(() -> unknownEncoding(request));
        if (refused.isPresent()) {
            refuse(request, response, refused.get(), callback);
            return true;
        }
        return encoding(request) == null
                ? notifications.handle(request, response, callback)
                : super.handle(request, response, callback);
    }

    private static String encoding(Request request) {
        return request.getHeaders().get(HttpHeader.CONTENT_ENCODING);
    }

    private static Optional<NotificationResponse> unknownEncoding(Request request) {
        String encoding = encoding(request);
        return encoding == null || encoding.equalsIgnoreCase("gzip")
                ? Optional.empty()
                : Optional.of(NotificationResponse.unknownEncoding());
    }

    /**
     * Reads and drops the body first: a sender that is still writing would see a closed connection instead of the
     * answer.
     */
    private void refuse(Request request, Response response, NotificationResponse refusal, Callback callback) {
        if (request.getLength() > maxBody) {
            response.getHeaders().put(HttpHeader.CONNECTION, "close");
            refusal.write(response, callback);
        } else {
            Content.Source.consumeAll(
                    request, Callback.from(() -> refusal.write(response, callback), callback::failed));
        }
    }
}
