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
public final class PageHandler extends Handler.Abstract.NonBlocking {
    private final Map<String, Supplier<Page>> pages;

    /** @param pages by path */
    public PageHandler(Map<String, Supplier<Page>> pages) {
        this.pages = Map.copyOf(pages);
    }

    @Override
    public boolean handle(Request request, Response response, Callback callback) {
        Supplier<Page> page = pages.get(Request.getPathInContext(request));
        if (page != null && (HttpMethod.GET.is(request.getMethod()) || HttpMethod.HEAD.is(request.getMethod()))) {
            show(page.get(), response, callback);
        } else {
            Answer.notAllowed().write(response, callback);
        }
        return true;
    }

    /** Jetty omits the body of an answer to {@code HEAD}. */
    private static void show(Page page, Response response, Callback callback) {
        response.getHeaders().put(HttpHeader.CACHE_CONTROL, "no-store");
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, page.contentType());
        response.getHeaders().put(HttpHeader.CONTENT_LENGTH, page.body().length);
        response.write(true, ByteBuffer.wrap(page.body()), callback);
    }
}
