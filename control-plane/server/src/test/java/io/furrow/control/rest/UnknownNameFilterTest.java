package io.furrow.control.rest;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.net.URI;

import com.fasterxml.jackson.databind.JsonNode;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.PATCH;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.core.Response;
import org.glassfish.jersey.internal.MapPropertiesDelegate;
import org.glassfish.jersey.server.ApplicationHandler;
import org.glassfish.jersey.server.ContainerRequest;
import org.glassfish.jersey.server.ContainerResponse;
import org.glassfish.jersey.server.ResourceConfig;
import org.glassfish.jersey.server.ServerProperties;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class UnknownNameFilterTest {
    private static final String BASE = "http://localhost/";

    /** Answers with the body of the request, for any path that is declared as in the API. */
    @Path("api")
    public static final class Echo {
        @POST
        @Path("missions")
        public Response mission(InputStream body) throws IOException {
            return Response.ok(body.readAllBytes()).build();
        }

        @POST
        @Path("domains")
        public Response domain(InputStream body) throws IOException {
            return mission(body);
        }

        @PATCH
        @Path("domains/{domain}")
        public Response change(InputStream body) throws IOException {
            return mission(body);
        }

        @DELETE
        @Path("domains/{domain}")
        public Response delete() throws IOException {
            return mission(InputStream.nullInputStream());
        }

        @POST
        @Path("templates")
        public Response template(InputStream body) throws IOException {
            return mission(body);
        }

        @POST
        @Path("replays")
        public Response replay(InputStream body) throws IOException {
            return mission(body);
        }

        @POST
        @Path("replays/{replay}/{command: pause|seek}")
        public Response steer(InputStream body) throws IOException {
            return mission(body);
        }

        @POST
        @Path("devices/{device}/commands")
        public Response command(InputStream body) throws IOException {
            return mission(body);
        }

        @POST
        @Path("fields")
        public Response fields(InputStream body) throws IOException {
            return mission(body);
        }

        @POST
        @Path("missions/{mission}/stop")
        public Response stop(InputStream body) throws IOException {
            return mission(body);
        }

        @GET
        @Path("missions")
        public Response missions() throws IOException {
            return delete();
        }

        @GET
        @Path("me")
        public Response me() throws IOException {
            return delete();
        }
    }

    /** A public page. */
    @Path("metrics")
    public static final class Metrics {
        @GET
        public Response page() {
            return Response.ok("".getBytes(UTF_8)).build();
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            POST   | api/missions             | {"mission":"m","domain":"d","tmplate":"t"}          | there is no member 'tmplate', did you mean 'template'?; known are devices, domain, mission, template
            POST   | api/missions             | {"devices":["urn:1",{"tpye":"Camera"}]}             | there is no member 'devices[1].tpye', did you mean 'type'?; known are area, at, attributes, carriedBy
            POST   | api/missions             | {"devices":[{"at":[{"latitude":1,"longtude":2}]}]}  | there is no member 'devices[0].at[0].longtude', did you mean 'longitude'?; known are latitude, longitude
            POST   | api/domains              | {"xyz":1}                                           | there is no member 'xyz'; known are area, description, domain, fields, name
            PATCH  | api/domains/north        | {"nmae":"North"}                                    | there is no member 'nmae', did you mean 'name'?; known are
            POST   | api/replays              | {"mission":"m","range":{"from":1,"until":2}}        | there is no member 'range.until'; known are from, to
            POST   | api/replays/m.1/seek     | {"TO":5}                                            | there is no member 'TO', did you mean 'to'?; known are count, from, speed, to
            POST   | api/missions/m/stop      | {"mission":"m","force":true}                        | there is no member 'force'; none is known
            POST   | api/domains?dryrun=true  | {"domain":"d"}                                      | there is no parameter 'dryrun', did you mean 'dryRun'?; known are dryRun
            DELETE | api/domains/north?froce= |                                                     | there is no parameter 'froce', did you mean 'force'?; known are dryRun, force
            GET    | api/missions?domian=d    |                                                     | there is no parameter 'domian', did you mean 'domain'?; known are domain
            GET    | api/me?x=1               |                                                     | there is no parameter 'x'; none is known
            """)
    void rejectsANameThatTheDescriptionDoesNotHave(String method, String path, String body, String reason)
            throws Exception {
        ContainerResponse answer = answer(method, path, body);

        assertThat(answer.getStatus()).isEqualTo(400);
        assertThat(answer.getMediaType()).hasToString("application/problem+json");
        JsonNode problem = NgsiJson.read((byte[]) answer.getEntity());
        assertThat(problem.path("error").asText())
                .isEqualTo(path.contains("?") ? "unknown-parameter" : "unknown-member");
        assertThat(problem.path("reason").asText()).startsWith(reason);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            POST   | api/missions                            | {"mission":"m","domain":"d","devices":["urn:1",{"type":"T","faults":[{"kind":"drift","perHour":1}],"parameters":{"any":{"thing":1}}}]}
            POST   | api/missions                            | {"devices":[{"type":"T","area":{"type":"Polygon","coordinates":[[[0,0]]],"note":"n"},"attributes":[{"name":"a","metadata":{}}]}]}
            POST   | api/templates                           | {"template":"t","version":3,"description":null,"devices":[{"type":"T","at":{"latitude":1,"longitude":2}}]}
            POST   | api/devices/d/commands?service=s&type=T | {"command":"on","value":{"any":["thing"]}}
            POST   | api/fields?domain=d&id-property=i       | {"type":"FeatureCollection"}
            PATCH  | api/domains/north                       | {"domain":"north","name":"North"}
            POST   | api/replays/m.1/seek                    | {"replay":"m.1","to":5}
            POST   | api/missions/m/stop                     | ``
            POST   | api/missions/m/stop                     | {"mission":"m"}
            DELETE | api/domains/north?force=true            | ``
            GET    | api/missions?domain=d                   | ``
            GET    | metrics?name=up                         | ``
            """)
    void passesOnWhatTheDescriptionHas(String method, String path, String body) throws Exception {
        ContainerResponse answer = answer(method, path, body);

        assertThat(answer.getStatus()).isEqualTo(200);
        assertThat(new String((byte[]) answer.getEntity(), UTF_8)).isEqualTo(body);
    }

    @ParameterizedTest
    @ValueSource(strings = {"force=yes", "force=", "force=TRUE", "dryRun=1", "dryRun=false&dryRun=true"})
    void rejectsAFlagThatIsNeitherTrueNorFalse(String query) throws Exception {
        ContainerResponse answer = answer("DELETE", "api/domains/north?" + query, null);

        assertThat(new String((byte[]) answer.getEntity(), UTF_8))
                .contains("\"wrong-member\"", "must be true or false, and given once");
    }

    @Test
    void rejectsARepeatedText() throws Exception {
        ContainerResponse answer = answer("GET", "api/missions?domain=a&domain=b", null);

        assertThat(new String((byte[]) answer.getEntity(), UTF_8)).contains("'domain' must be a text, and given once");
    }

    @Test
    void rejectsAnotherNameThanThatOfThePath() throws Exception {
        ContainerResponse answer = answer("PATCH", "api/domains/north", "{\"domain\":\"south\"}");

        assertThat(new String((byte[]) answer.getEntity(), UTF_8))
                .contains("\"wrong-member\"", "'domain' must be 'north' as in the path");
    }

    @Test
    void quotesALongNameInPart() throws Exception {
        String name = "x".repeat(63) + "\\ud83d\\ude00";

        ContainerResponse answer = answer("POST", "api/domains", "{\"%s\":1}".formatted(name));

        assertThat(new String((byte[]) answer.getEntity(), UTF_8)).contains("no member '" + "x".repeat(63) + "?…'");
    }

    private static ContainerResponse answer(String method, String path, String body) throws Exception {
        ResourceConfig config = new ResourceConfig(Echo.class, Metrics.class);
        config.property(ServerProperties.WADL_FEATURE_DISABLE, true);
        config.register(new UnknownNameFilter(ApiDescription.read()));
        config.register(new JsonExceptionMapper());
        ContainerRequest request = new ContainerRequest(
                URI.create(BASE), URI.create(BASE + path), method, null, new MapPropertiesDelegate(), config);
        request.setEntityStream(new ByteArrayInputStream(body == null ? new byte[0] : body.getBytes(UTF_8)));
        return new ApplicationHandler(config).apply(request).get();
    }
}
