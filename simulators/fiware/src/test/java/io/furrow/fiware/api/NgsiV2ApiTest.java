package io.furrow.fiware.api;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.fiware.Client;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.fiware.http.LoopbackServer;

import static org.assertj.core.api.Assertions.assertThat;

class NgsiV2ApiTest {
    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());

    private final Client client = Client.of(standIn.contextBroker());

    @BeforeEach
    void storeTwoProbes() {
        create(1, 20.5);
        create(2, 30);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '"',
            nullValues = "-",
            value = {
                "GET    | /v2/entities/none                  | -                        | 404 | NotFound | The requested entity has not been found. Check type and id",
                "GET    | /v2/entities/M%25C3%25BCller       | -                        | 404 | NotFound | The requested entity has not been found. Check type and id",
                "GET    | /v2/entities/P1?type=Other         | -                        | 404 | NotFound | The requested entity has not been found. Check type and id",
                "DELETE | /v2/entities/none                  | -                        | 404 | NotFound | The requested entity has not been found. Check type and id",
                "DELETE | /v2/entities/P1/attrs/none         | -                        | 404 | NotFound | The entity does not have such an attribute",
                "PATCH  | /v2/entities/none/attrs            | {'a':{'value':1}}        | 404 | NotFound | The requested entity has not been found. Check type and id",
                "PATCH  | /v2/entities/P1/attrs              | {'a':{'value':1}}        | 422 | Unprocessable | do not exist: P1 - [ a ]",
                "PATCH  | /v2/entities/P1/attrs?type=Probe   | {'b':{'value':1},'a':{'value':1}} | 422 | Unprocessable | do not exist: P1/Probe - [ a, b ]",
                "POST   | /v2/entities                       | {'id':'F','a':{'value':'x=y'}} | 400 | BadRequest | Invalid characters in attribute value",
                "POST   | /v2/entities?options=keyValues     | {'id':'F','a':{'deep':['(x)']}} | 400 | BadRequest | Invalid characters in attribute value",
                "POST   | /v2/entities                       | {'id':'F','a':{'value':1,'metadata':{'m':{'value':'a;b'}}}} | 400 | BadRequest | Invalid characters in metadata value",
                "POST   | /v2/op/update                      | {'actionType':'append','entities':[{'id':'ok'},{'id':'F','a':{'value':'x=y'}}]} | 400 | BadRequest | Invalid characters in attribute value",
                "PATCH  | /v2/entities/P1/attrs              | -                        | 411 | ContentLengthRequired | Zero/No Content-Length in PUT/POST/PATCH request",
                "POST   | /v2/entities/P1/attrs              | {'dateModified':{'value':1}} | 400 | BadRequest | the name 'dateModified' is reserved and cannot be that of an attribute",
                "POST   | /v2/op/update?options=keyValues    | {'actionType':'append','entities':[{'id':'F','servicePath':'/a'}]} | 400 | BadRequest | the name 'servicePath' is reserved and cannot be that of an attribute",
                "PATCH  | /v2/entities/P1/attrs              | {'id':'x'}               | 400 | BadRequest | entity id specified in payload",
                "PATCH  | /v2/entities/P1/attrs              | {'a':1}                  | 400 | BadRequest | attribute must be a JSON object, unless keyValues option is used",
                "POST   | /v2/entities/P1/attrs              | {}                       | 400 | BadRequest | empty payload",
                "POST   | /v2/entities                       | {'id':'P1','type':'Probe'} | 422 | Unprocessable | Already Exists",
                "POST   | /v2/entities                       | {'id':'P 1'}             | 400 | BadRequest | Invalid characters in entity id",
                "POST   | /v2/entities                       | {'type':'Probe'}         | 400 | BadRequest | entity id length: 0, min length supported: 1",
                "POST   | /v2/entities                       | {'id':                   | 400 | ParseError | Errors found in incoming JSON buffer",
                "POST   | /v2/entities                       | {'id':'D','at':{'type':'DateTime','value':'soon'}} | 400 | BadRequest | date has invalid format in attribute value",
                "PUT    | /v2/entities                       | {}                       | 405 | MethodNotAllowed | method not allowed",
                "GET    | /v2/nothing                        | -                        | 400 | BadRequest | Service not found. Check your URL as probably it is wrong.",
                "GET    | /v2/entities?limit=1001            | -                        | 400 | BadRequest | Bad pagination limit: /1001/ [max: 1000]",
                "GET    | /v2/entities?offset=x              | -                        | 400 | BadRequest | Bad pagination offset: /x/ [must be a decimal number]",
                "GET    | /v2/entities?georel=near           | -                        | 400 | BadRequest | not supported by the stand-in: parameter 'georel' in a query of entities",
                "GET    | /v2/entities?q=moisture%3E25       | -                        | 400 | BadRequest | not supported by the stand-in: q 'moisture>25'",
                "GET    | /v2/entities?orderBy=moisture      | -                        | 400 | BadRequest | not supported by the stand-in: orderBy 'moisture'",
                "GET    | /v2/entities?options=values        | -                        | 400 | BadRequest | not supported by the stand-in: option 'values'",
                "POST   | /v2/op/query                       | {'expression':{'q':'a'}} | 400 | BadRequest | not supported by the stand-in: a query by anything but entities",
                "POST   | /v2/op/query                       | {'entities':[{'idPattern':'.*'}]} | 400 | BadRequest | not supported by the stand-in: a query of entities without an id",
                "POST   | /v2/op/update                      | {'actionType':'appendStrict','entities':[{'id':'P1'}]} | 400 | BadRequest | not supported by the stand-in: actionType 'appendStrict'",
                "GET    | /v2/subscriptions/000000000000000000000000 | -                | 404 | NotFound | The requested subscription has not been found. Check id",
                "POST   | /v2/op/update                      | {'actionType':'append','entities':[]} | 400 | BadRequest | empty entities vector",
                "POST   | /v2/op/update                      | {'actionType':'update','entities':[{'id':'none','a':{'value':1}}]} | 404 | NotFound | do not exist: none - [entity itself]",
            })
    void refusesAsOrionDoes(String method, String path, String body, int status, String error, String description) {
        Client.Answer answer = client.send(method, path, body == null ? "" : body.replace('\'', '"'));

        assertThat(answer.status()).as(answer.body()).isEqualTo(status);
        assertThat(answer.body()).isEqualTo("{\"error\":\"" + error + "\",\"description\":\"" + description + "\"}");
    }

    @Test
    void rejectsABodyThatIsNoJsonByItsTypeOrItsSize() {
        assertThat(client.with("Content-Type", "text/plain")
                        .post("/v2/entities", "{\"id\":\"x\"}")
                        .status())
                .isEqualTo(415);
        assertThat(client.post("/v2/entities", "{\"id\":\"" + "x".repeat(LoopbackServer.MAX_BODY) + "\"}")
                        .body())
                .startsWith("{\"error\":\"RequestEntityTooLarge\"");
    }

    @Test
    void retainsAnEntityThroughItsWholeLife() {
        Client.Answer created = client.post("/v2/entities?options=keyValues", """
                {"id": "urn:ngsi-ld:Robot:1", "type": "Robot", "speed": 1.50, "name": "one", "gone": true}""");
        assertThat(created.status()).isEqualTo(201);
        assertThat(created.location()).isEqualTo("/v2/entities/urn:ngsi-ld:Robot:1?type=Robot");

        String path = "/v2/entities/urn:ngsi-ld:Robot:1/attrs";
        assertThat(client.patch(path, "{\"speed\": {\"value\": 2, \"metadata\": {\"unit\": {\"value\": \"m/s\"}}}}")
                        .status())
                .isEqualTo(204);
        assertThat(client.post(path + "?options=keyValues", "{\"job\": \"mow\"}")
                        .status())
                .isEqualTo(204);
        assertThat(client.patch(path + "?options=keyValues", "{\"name\": \"two\"}")
                        .status())
                .isEqualTo(204);
        assertThat(client.delete(path + "/gone").status()).isEqualTo(204);
        assertThat(client.get("/v2/entities/urn:ngsi-ld:Robot:1").body()).isEqualTo("""
                {"id":"urn:ngsi-ld:Robot:1","type":"Robot",\
                "job":{"type":"Text","value":"mow","metadata":{}},\
                "name":{"type":"Text","value":"two","metadata":{}},\
                "speed":{"type":"Number","value":2,"metadata":{"unit":{"type":"Text","value":"m/s"}}}}""");

        assertThat(client.send("PUT", path, "{\"speed\": {\"value\": 3}}").status())
                .isEqualTo(204);
        assertThat(client.get("/v2/entities/urn:ngsi-ld:Robot:1").body()).isEqualTo("""
                {"id":"urn:ngsi-ld:Robot:1","type":"Robot","speed":{"type":"Number","value":3,"metadata":{}}}""");

        assertThat(client.delete("/v2/entities/urn:ngsi-ld:Robot:1").status()).isEqualTo(204);
        assertThat(client.get("/v2/entities/urn:ngsi-ld:Robot:1").status()).isEqualTo(404);
    }

    @Test
    void updatesTheAttributesThatExistAndNamesTheOthers() {
        Client.Answer answer =
                client.patch("/v2/entities/P1/attrs?options=keyValues", "{\"moisture\": 5, \"lost\": 1}");

        assertThat(answer.status()).isEqualTo(422);
        assertThat(answer.json().path("error").asText()).isEqualTo("PartialUpdate");
        assertThat(answer.json().path("description").asText()).contains("lost").doesNotContain("moisture");
        assertThat(client.value("P1", "moisture")).hasToString("5");
    }

    @Test
    void requestsATypeWhereAnIdIsNotEnough() {
        client.post("/v2/entities", "{\"id\": \"P1\", \"type\": \"Pump\"}");

        Client.Answer answer = client.get("/v2/entities/P1");

        assertThat(answer.status()).isEqualTo(409);
        assertThat(answer.json().path("error").asText()).isEqualTo("TooManyResults");
        assertThat(client.get("/v2/entities/P1?type=Pump").status()).isEqualTo(200);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '"',
            value = {
                "/v2/entities?options=count                        | P1 P2",
                "/v2/entities?options=count&type=Probe             | P1 P2",
                "/v2/entities?options=count&type=Pump              | \"\"",
                "/v2/entities?options=count&type=Pump,Probe&id=P2  | P2",
                "/v2/entities?options=count&idPattern=%5EP.$       | P1 P2",
                "/v2/entities?options=count&typePattern=be$        | P1 P2",
                "/v2/entities?options=count&q=dateModified%3E=2026-01-01T00:00:00%2B01:00 | P1 P2",
                "/v2/entities?options=count&q=dateCreated%3E=9999-12-31                   | \"\"",
                "/v2/entities?options=count&orderBy=!dateModified,!id                     | P2 P1",
            })
    void listsWhatAQueryRequests(String path, String ids) {
        Client.Answer answer = client.get(path);

        List<String> found = answer.json().findValuesAsText("id");
        assertThat(String.join(" ", found)).isEqualTo(ids);
        assertThat(answer.total()).isEqualTo(Integer.toString(found.size()));
    }

    @Test
    void findsTheEntitiesThatABatchNames() {
        Client.Answer found = client.post("/v2/op/query?limit=2", """
                {"entities": [{"id": "P2", "type": "Probe"}, {"id": "P1", "type": "Pump"}, {"id": "P1"}],
                 "attrs": ["moisture"], "metadata": ["none"]}""");

        assertThat(found.body()).isEqualTo("""
                [{"id":"P2","type":"Probe","moisture":{"type":"Number","value":30,"metadata":{}}},\
                {"id":"P1","type":"Probe","moisture":{"type":"Number","value":20.5,"metadata":{}}}]""");
    }

    @Test
    void listsPageByPage() {
        Client.Answer second = client.get("/v2/entities?limit=1&offset=1&options=count,keyValues");

        assertThat(second.body()).isEqualTo("[{\"id\":\"P2\",\"type\":\"Probe\",\"moisture\":30}]");
        assertThat(second.total()).isEqualTo("2");
    }

    @Test
    void showsTheAttributesThatAreRequested() {
        JsonNode found =
                client.get("/v2/entities/P1?attrs=dateModified,servicePath").json();

        assertThat(found.has("moisture")).isFalse();
        assertThat(found.at("/servicePath/value").asText()).isEqualTo("/plot1");
        assertThat(found.at("/dateModified/value").asText()).matches("\\d{4}-\\d\\d-\\d\\dT.*\\.\\d{3}Z");
    }

    @Test
    void separatesTenantsAndServicePaths() {
        client.as("other", "/plot1").post("/v2/entities", "{\"id\": \"P1\", \"type\": \"Probe\"}");
        client.as("agri", "/plot1/sub").post("/v2/entities", "{\"id\": \"P3\", \"type\": \"Probe\"}");

        assertThat(ids(client.as("other", "/plot1"))).isEqualTo(List.of("P1"));
        assertThat(ids(client.as("agri", "/plot1"))).isEqualTo(List.of("P1", "P2"));
        assertThat(ids(client.as("agri", "/plot1/#"))).isEqualTo(List.of("P1", "P2", "P3"));
        assertThat(ids(client.as("agri", "/plot2,/plot1/sub"))).isEqualTo(List.of("P3"));
        assertThat(ids(client.as("agri", "/#"))).hasSize(3);
        assertThat(ids(client.as("none", "/#"))).isEmpty();
        assertThat(client.as("bad-tenant", "/").get("/v2/entities").status()).isEqualTo(400);
        assertThat(client.as("agri", "plot1").get("/v2/entities").status()).isEqualTo(400);
    }

    @Test
    void doesTheRestOfABatchWhenOneEntityIsRefused() {
        Client.Answer answer = client.post("/v2/op/update?options=keyValues", """
                {"actionType": "update", "entities": [
                    {"id": "none", "type": "Probe", "moisture": 1}, {"id": "P2", "type": "Probe", "moisture": 1}]}""");

        assertThat(answer.status()).isEqualTo(422);
        assertThat(answer.json().path("error").asText()).isEqualTo("PartialUpdate");
        assertThat(client.value("P2", "moisture")).hasToString("1");
    }

    @Test
    void retainsAnyTextOfAnAttributeThatIsUnrestricted() {
        String text = "{\"value\": [\"<a href='x'>;(=)</a>\"], \"type\": \"TextUnrestricted\"}";

        assertThat(client.post("/v2/entities", "{\"id\": \"F\", \"note\": " + text + "}")
                        .status())
                .isEqualTo(201);
        assertThat(client.value("F", "note")).hasToString("[\"<a href='x'>;(=)</a>\"]");
    }

    @Test
    void namesAllThatABatchDidNotFind() {
        Client.Answer answer = client.post("/v2/op/update?options=keyValues", """
                {"actionType": "update", "entities": [{"id": "none", "moisture": 1}, {"id": "P1", "type": "Probe", "lost": 1},
                    {"id": "P2", "type": "Probe", "moisture": 1}]}""");

        assertThat(answer.body())
                .isEqualTo("{\"error\":\"PartialUpdate\",\"description\":\"do not exist: none - [entity itself],"
                        + " do not exist: P1/Probe - [ lost ]\"}");
    }

    @Test
    void reportsWhatItIs() {
        assertThat(client.get("/version").json().at("/orion/version").asText())
                .startsWith("4.7")
                .contains("stand-in");
    }

    private static List<String> ids(Client client) {
        return client.get("/v2/entities").json().findValuesAsText("id");
    }

    private void create(int number, double moisture) {
        Client.Answer answer = client.post("/v2/entities?options=keyValues", """
                {"id": "P%d", "type": "Probe", "moisture": %s}""".formatted(number, moisture));
        assertThat(answer.status()).as(answer.body()).isEqualTo(201);
    }
}
