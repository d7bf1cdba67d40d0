package io.furrow.connect.source.http;

import java.nio.ByteBuffer;
import java.util.Map;
import java.util.function.Supplier;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

/** Serves the pages to {@code GET} and {@code HEAD}; answers all other methods with 405. */
public final class StatusHandler extends Handler.Abstract.NonBlocking {
    private final Map<String, Supplier<StatusPage>> pages;

    /** @param pages by path */
    public StatusHandler(Map<String, Supplier<StatusPage>> pages) {
        this.pages = Map.copyOf(pages);
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        Supplier<StatusPage> page = pages.get(Request.getPathInContext(request));
        if (page != null && (HttpMethod.GET.is(request.getMethod()) || HttpMethod.HEAD.is(request.getMethod()))) {
            show(page.get(), response, callback);
        } else {
            NotificationResponse.notAllowed().write(response, callback);
        }
        return true;
    }

    /** Jetty omits the body of an answer to {@code HEAD}. */
    private static void show(StatusPage statusPage, Response response, Callback callback) {
        response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, statusPage.contentType());
        response.getHeaders().put(HttpHeader.CONTENT_LENGTH, statusPage.body().length);
        response.write(true, ByteBuffer.wrap(statusPage.body()), callback);
    }
}
