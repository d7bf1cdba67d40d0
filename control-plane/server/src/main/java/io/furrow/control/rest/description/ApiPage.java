package io.furrow.control.rest.description;

import java.util.List;

import org.eclipse.jetty.http.pathmap.ServletPathSpec;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.handler.PathMappingsHandler;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.resource.ResourceFactory;

import io.furrow.http.jetty.StaticFiles;

/** Serves the page that shows the description of the API, at {@value #PATH}, with Swagger UI from its WebJar. */
public final class ApiPage {
    private static final String PATH = "/api/";
    private static final String FILES = "/api/page";
    /** Swagger UI has its icons as data, and asks no other server. */
    private static final String CONTENT_POLICY =
            "default-src 'self'; img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

    private ApiPage() {}

    /** @param api answers all other requests */
    public static Handler before(Handler api) {
        PathMappingsHandler paths = new PathMappingsHandler();
        ResourceFactory resources = ResourceFactory.of(paths);
        var own = StaticFiles.classPath(resources, "io/furrow/control/rest/page/", "index.html");
        var viewer = StaticFiles.webJar(resources, "org.webjars", "swagger-ui", "", "swagger-ui.css");
        Handler page = protectedPage(StaticFiles.context("/api", own));
        for (String path : List.of("/api", PATH)) {
            paths.addMapping(new ServletPathSpec(path), page);
        }
        paths.addMapping(
                new ServletPathSpec(FILES + "/*"),
                protectedPage(StaticFiles.context(FILES, ResourceFactory.combine(own, viewer))));
        paths.addMapping(new ServletPathSpec("/*"), api);
        return paths;
    }

    private static Handler protectedPage(Handler files) {
        return new Handler.Wrapper(files) {
            @Override
            public boolean handle(Request request, Response response, Callback callback) throws Exception {
                response.getHeaders().put("X-Content-Type-Options", "nosniff");
                response.getHeaders().put("Referrer-Policy", "no-referrer");
                response.getHeaders().put("Content-Security-Policy", CONTENT_POLICY);
                return super.handle(request, response, callback);
            }
        };
    }
}
