package io.furrow.dashboard.page;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;

import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.handler.ContextHandlerCollection;
import org.eclipse.jetty.server.handler.gzip.GzipHandler;
import org.eclipse.jetty.util.resource.Resource;
import org.eclipse.jetty.util.resource.ResourceFactory;

import io.furrow.http.jetty.StaticFiles;

/** Serves the page at {@code /}, and each library at {@code /lib/<name>/} from its WebJar. */
public final class PageFiles {
    /**
     * Flink's web UI also has a folder with this name on the class path of a suite; {@code app.js} identifies the right
     * one.
     */
    private static final String WEB = "web/";
    /** Libraries, and for each a file in its folder {@code dist}. */
    private static final Map<String, String> LIBRARIES = Map.of("ol", "ol.js", "uplot", "uPlot.esm.js");

    private static final String NPM = "org.webjars.npm";

    private PageFiles() {}

    /**
     * @param folder with the files of the page, for development; null for those of this build
     * @throws IOException if the folder has no page
     */
    public static Handler handler(Path folder) throws IOException {
        if (folder != null && !Files.isRegularFile(folder.resolve("index.html"))) {
            throw new IOException(
                    "%s has no index.html. Name the folder with the files of the page, dashboard/src/main/resources/web."
                            .formatted(folder));
        }
        ContextHandlerCollection contexts = new ContextHandlerCollection();
        ResourceFactory resources = ResourceFactory.of(contexts);
        LIBRARIES.forEach((library, file) ->
                contexts.addHandler(StaticFiles.context("/lib/" + library, library(resources, library, file))));
        contexts.addHandler(StaticFiles.context(
                "/", folder == null ? StaticFiles.classPath(resources, WEB, "app.js") : resources.newResource(folder)));
        GzipHandler gzip = new GzipHandler();
        gzip.setHandler(contexts);
        return gzip;
    }

    private static Resource library(ResourceFactory resources, String name, String file) {
        return ResourceFactory.combine(
                StaticFiles.webJar(resources, NPM, name, "dist/", file),
                StaticFiles.webJar(resources, NPM, name, "", "package.json"));
    }
}
