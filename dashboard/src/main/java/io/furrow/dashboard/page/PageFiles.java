package io.furrow.dashboard.page;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.URL;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.Properties;

import org.eclipse.jetty.http.CompressedContentFormat;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.handler.ContextHandler;
import org.eclipse.jetty.server.handler.ContextHandlerCollection;
import org.eclipse.jetty.server.handler.ResourceHandler;
import org.eclipse.jetty.server.handler.gzip.GzipHandler;
import org.eclipse.jetty.util.URIUtil;
import org.eclipse.jetty.util.resource.Resource;
import org.eclipse.jetty.util.resource.ResourceFactory;

/** Serves the page at {@code /}, and each library at {@code /lib/<name>/} from its WebJar. */
public final class PageFiles {
    /**
     * Flink's web UI also has a folder with this name on the class path of a suite; {@code app.js} identifies the right
     * one.
     */
    private static final String WEB = "web/";
    /** Libraries, and for each a file in its folder {@code dist}. */
    private static final Map<String, String> LIBRARIES = Map.of("ol", "ol.js", "uplot", "uPlot.esm.js");
    /** Browsers may cache a file, but must revalidate it by its ETag. */
    private static final String REVALIDATE = "no-cache";

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
        for (String library : LIBRARIES.keySet()) {
            contexts.addHandler(context("/lib/" + library, library(contexts, library)));
        }
        ResourceFactory resources = ResourceFactory.of(contexts);
        contexts.addHandler(
                context("/", folder == null ? classPath(resources, WEB, "app.js") : resources.newResource(folder)));
        GzipHandler gzip = new GzipHandler();
        gzip.setHandler(contexts);
        return gzip;
    }

    private static Resource library(ContextHandlerCollection owner, String name) {
        ResourceFactory resources = ResourceFactory.of(owner);
        String root = "META-INF/resources/webjars/%s/%s/".formatted(name, version(name));
        return ResourceFactory.combine(
                classPath(resources, root + "dist/", LIBRARIES.get(name)), classPath(resources, root, "package.json"));
    }

    /** Finds a folder by a file in it, since a jar need not have entries for folders. */
    private static Resource classPath(ResourceFactory resources, String folder, String file) {
        URL found = PageFiles.class.getClassLoader().getResource(folder + file);
        if (found == null) {
            throw new IllegalStateException(
                    folder + file + " is not on the class path: the dashboard was not built as a whole");
        }
        // The class loader returns jar:file:/, Jetty expects jar:file:///: without correction it treats the folder as
        // an alias, without a welcome file.
        return resources.newResource(URIUtil.correctURI(
                URI.create(found.toString().substring(0, found.toString().length() - file.length()))));
    }

    private static String version(String library) {
        String path = "META-INF/maven/org.webjars.npm/%s/pom.properties".formatted(library);
        try (InputStream stream = PageFiles.class.getClassLoader().getResourceAsStream(path)) {
            if (stream == null) {
                throw new IllegalStateException("the WebJar of " + library + " is not on the class path");
            }
            Properties properties = new Properties();
            properties.load(stream);
            return properties.getProperty("version");
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static Handler context(String path, Resource base) {
        ResourceHandler files = new ResourceHandler();
        files.setBaseResource(base);
        files.setDirAllowed(false);
        files.setEtags(true);
        files.setWelcomeFiles("index.html");
        files.setCacheControl(REVALIDATE);
        files.setPrecompressedFormats(new CompressedContentFormat[0]);
        ContextHandler context = new ContextHandler(files, path);
        context.setAllowNullPathInContext(true);
        return context;
    }
}
