package io.furrow.dashboard.page;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;

import org.eclipse.jetty.http.pathmap.ServletPathSpec;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.handler.PathMappingsHandler;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TileFileTest {
    private static final int PNG = 2;
    private static final int GZIP = 2;
    private static final int LENGTH = 100_000;

    @TempDir
    Path directory;

    /** Creates a file whose header is as given; every other byte depends on its position. */
    private Path file(String magic, int version, int compression, int type) throws IOException {
        byte[] bytes = new byte[LENGTH];
        for (int i = 0; i < LENGTH; i++) {
            bytes[i] = (byte) (i % 251);
        }
        System.arraycopy(magic.getBytes(US_ASCII), 0, bytes, 0, magic.length());
        bytes[7] = (byte) version;
        bytes[97] = (byte) compression;
        bytes[98] = 1;
        bytes[99] = (byte) type;
        return Files.write(directory.resolve("tiles.pmtiles"), bytes);
    }

    private interface ServerTest {
        void run(URI uri) throws Exception;
    }

    private void serving(Path file, ServerTest test) throws Exception {
        Server server = new Server();
        ServerConnector connector = new ServerConnector(server);
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        PathMappingsHandler paths = new PathMappingsHandler();
        paths.addMapping(new ServletPathSpec(TileFile.PATH), TileFile.handler(file));
        server.setHandler(paths);
        server.start();
        try {
            test.run(URI.create("http://127.0.0.1:" + connector.getLocalPort()));
        } finally {
            server.stop();
        }
    }

    private static HttpResponse<byte[]> send(URI uri, String path, String method, String... headers) throws Exception {
        var request = HttpRequest.newBuilder(uri.resolve(path)).method(method, HttpRequest.BodyPublishers.noBody());
        if (headers.length > 0) {
            request.headers(headers);
        }
        return HttpClient.newHttpClient().send(request.build(), HttpResponse.BodyHandlers.ofByteArray());
    }

    @Test
    void servesRequestedRanges() throws Exception {
        Path file = file("PMTiles", 3, GZIP, PNG);
        byte[] all = Files.readAllBytes(file);
        serving(file, uri -> {
            HttpResponse<byte[]> part = send(uri, TileFile.PATH, "GET", "Range", "bytes=70000-70999");
            assertThat(part.statusCode()).isEqualTo(206);
            assertThat(part.body()).isEqualTo(Arrays.copyOfRange(all, 70_000, 71_000));
            assertThat(part.headers().firstValue("Content-Range")).contains("bytes 70000-70999/" + LENGTH);
            assertThat(part.headers().firstValue("Content-Encoding")).isEmpty();

            HttpResponse<byte[]> head = send(uri, TileFile.PATH, "HEAD");
            assertThat(head.statusCode()).isEqualTo(200);
            assertThat(head.body()).isEmpty();
            assertThat(head.headers().firstValue("Content-Length")).contains(Integer.toString(LENGTH));
            assertThat(head.headers().firstValue("Accept-Ranges")).contains("bytes");
            assertThat(head.headers().firstValue("ETag")).isPresent();
            assertThat(send(uri, TileFile.PATH, "GET").body()).isEqualTo(all);
            assertThat(send(uri, TileFile.PATH, "GET", "Range", "bytes=" + LENGTH + "-")
                            .statusCode())
                    .isEqualTo(416);
        });
    }

    @Test
    void isReadOnlyAndServesNoOtherFile() throws Exception {
        Path file = file("PMTiles", 3, GZIP, PNG);
        Files.writeString(directory.resolve("secret"), "secret");
        serving(file, uri -> {
            for (String method : new String[] {"POST", "PUT", "DELETE"}) {
                assertThat(send(uri, TileFile.PATH, method).statusCode())
                        .as(method)
                        .isEqualTo(405);
            }
            for (String path : new String[] {
                "/tiles/",
                "/tiles/secret",
                "/tiles/tiles.pmtiles",
                TileFile.PATH + "/",
                TileFile.PATH + "/secret",
                TileFile.PATH + "/../secret"
            }) {
                assertThat(send(uri, path, "GET").statusCode()).as(path).isEqualTo(404);
            }
        });
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            MBTiles | 3 | 2 | 2 | is not a PMTiles file of version 3
            PMTiles | 2 | 2 | 2 | is not a PMTiles file of version 3
            PMTiles | 3 | 2 | 1 | has vector tiles
            PMTiles | 3 | 2 | 0 | does not say that its tiles are PNG
            PMTiles | 3 | 2 | 6 | does not say that its tiles are PNG
            PMTiles | 3 | 4 | 2 | is compressed in a way
            """)
    void rejectsFilesThatThePageCannotDraw(String magic, int version, int compression, int type, String why) {
        assertThatThrownBy(() -> TileFile.handler(file(magic, version, compression, type)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("tiles.pmtiles " + why);
    }

    @Test
    void rejectsAMissingFileAndOneWithoutAHeader() throws Exception {
        assertThatThrownBy(() -> TileFile.handler(directory.resolve("missing")))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("There is no file of tiles", "Check --tiles");
        Path tooShort = Files.writeString(directory.resolve("short_"), "PMTiles");
        assertThatThrownBy(() -> TileFile.handler(tooShort))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("is not a PMTiles file");
    }
}
