package io.furrow.http.jetty;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.URL;
import java.util.Properties;

import org.eclipse.jetty.http.CompressedContentFormat;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.handler.ContextHandler;
import org.eclipse.jetty.server.handler.ResourceHandler;
import org.eclipse.jetty.util.URIUtil;
import org.eclipse.jetty.util.resource.Resource;
import org.eclipse.jetty.util.resource.ResourceFactory;

/** Serves the files of a page from the class path, the libraries among them from their WebJars. */
public final class StaticFiles {
    /** Browsers may cache a file, but must revalidate it by its ETag. */
    private static final String REVALIDATE = "no-cache";

    private StaticFiles() {}

    /** Serves the files of a folder below a path, for the path itself {@code index.html}. */
    public static Handler context(String path, Resource base) {
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

    /** Finds a folder by a file in it, since a jar need not have entries for folders. */
    public static Resource classPath(ResourceFactory resources, String folder, String file) {
        URL found = StaticFiles.class.getClassLoader().getResource(folder + file);
        if (found == null) {
            throw new IllegalStateException(
                    folder + file + " is not on the class path: Furrow was not built as a whole");
        }
        // The class loader returns jar:file:/, Jetty expects jar:file:///: without correction it treats the folder as
        // an alias, without a welcome file.
        return resources.newResource(URIUtil.correctURI(
                URI.create(found.toString().substring(0, found.toString().length() - file.length()))));
    }

    /**
     * Finds a folder of a library.
     *
     * @param group of its WebJar
     * @param folder in the library, with a slash at its end; empty for the whole library
     * @param file in the folder
     */
    public static Resource webJar(ResourceFactory resources, String group, String library, String folder, String file) {
        String root = "META-INF/resources/webjars/%s/%s/".formatted(library, version(group, library));
        return classPath(resources, root + folder, file);
    }

    private static String version(String group, String library) {
        String path = "META-INF/maven/%s/%s/pom.properties".formatted(group, library);
        try (InputStream stream = StaticFiles.class.getClassLoader().getResourceAsStream(path)) {
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
}
