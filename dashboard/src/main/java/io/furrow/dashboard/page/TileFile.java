package io.furrow.dashboard.page;

import java.io.IOException;
import java.io.InputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;

import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.http.content.HttpContent;
import org.eclipse.jetty.http.content.ResourceHttpContent;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.handler.ContextHandler;
import org.eclipse.jetty.server.handler.ResourceHandler;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.resource.Resource;
import org.eclipse.jetty.util.resource.ResourceFactory;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.file.FileProblem;

/**
 * Serves a file of map tiles in PMTiles, version 3, at {@value #PATH}: the page reads parts of it with range requests.
 * Format: <a href="https://github.com/protomaps/PMTiles/blob/main/spec/v3/spec.md">PMTiles specification</a>.
 */
public final class TileFile {
    /** The path of the file. */
    public static final String PATH = "/tiles/base.pmtiles";

    private static final String TYPE = "application/vnd.pmtiles";
    private static final byte[] MAGIC = "PMTiles".getBytes(StandardCharsets.US_ASCII);
    private static final int HEADER = 127;
    private static final int VERSION_AT = 7;
    private static final int VERSION = 3;
    private static final int DIRECTORIES_AT = 97;
    private static final int TILES_AT = 98;
    private static final int TYPE_AT = 99;
    private static final int NONE = 1;
    private static final int GZIP = 2;
    /** Vector tiles; the types above up to AVIF are images: PNG, JPEG, WebP and AVIF. */
    private static final int VECTOR = 1;

    private static final int AVIF = 5;

    private TileFile() {}

    /**
     * Serves the file.
     *
     * @throws IOException if the page cannot draw the file; the message says why
     */
    public static Handler handler(Path file) throws IOException {
        check(file);
        ContextHandler context = new ContextHandler(PATH);
        context.setAllowNullPathInContext(true);
        ResourceHandler handler = new SingleFile(ResourceFactory.of(context).newResource(file.toAbsolutePath()));
        handler.setEtags(true);
        handler.setCacheControl("no-cache");
        context.setHandler(handler);
        return context;
    }

    private static void check(Path file) throws IOException {
        byte[] header;
        try (InputStream in = Files.newInputStream(file)) {
            header = in.readNBytes(HEADER);
        } catch (NoSuchFileException e) {
            throw new IOException("There is no file of tiles %s. Check --tiles.".formatted(file), e);
        } catch (IOException e) {
            throw new IOException("The file of tiles %s cannot be read (%s).".formatted(file, FileProblem.of(e)), e);
        }
        boolean valid = header.length == HEADER
                && ByteBuffer.wrap(header, 0, MAGIC.length).equals(ByteBuffer.wrap(MAGIC))
                && header[VERSION_AT] == VERSION;
        if (!valid) {
            throw new IOException(
                    "%s is not a PMTiles file of version 3. 'pmtiles convert' makes one of MBTiles.".formatted(file));
        }
        if (header[TYPE_AT] == VECTOR) {
            throw new IOException(
                    "%s has vector tiles. The page draws pictures: PNG, JPEG, WebP or AVIF.".formatted(file));
        }
        if (header[TYPE_AT] < VECTOR || header[TYPE_AT] > AVIF) {
            throw new IOException("%s does not say that its tiles are PNG, JPEG, WebP or AVIF.".formatted(file));
        }
        if (!isReadable(header[DIRECTORIES_AT]) || !isReadable(header[TILES_AT])) {
            throw new IOException(
                    "%s is compressed in a way that browsers do not read. Use gzip, or none.".formatted(file));
        }
    }

    private static boolean isReadable(byte compression) {
        return compression == NONE || compression == GZIP;
    }

    /** Serves the file alone; paths below it do not exist. */
    private static final class SingleFile extends ResourceHandler {
        private final Resource file;

        SingleFile(Resource file) {
            this.file = file;
        }

        @Override
        protected HttpContent.Factory newHttpContentFactory() {
            return path -> path.isEmpty() || path.equals("/") ? new ResourceHttpContent(file, TYPE) : null;
        }

        @Override
        public boolean handle(Request request, Response response, Callback callback) throws Exception {
            boolean reads = HttpMethod.GET.is(request.getMethod()) || HttpMethod.HEAD.is(request.getMethod());
            if (reads) {
                return super.handle(request, response, callback);
            }
            response.getHeaders().put(HttpHeader.ALLOW, "GET, HEAD");
            new Problem(405, "method-not-allowed", "tiles are read with GET").answer(response, callback);
            return true;
        }
    }
}
