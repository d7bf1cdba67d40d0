package io.furrow.http;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvFileSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AccessRuleTest {
    private static final OptionNames NAMES = new OptionNames("--allowed-hosts", "--allowed-origins");
    private static final AccessRule RULE = AccessRule.allowing(
                    new AllowedNames(
                            List.of("Farm.example.org.", "2001:db8::7"),
                            List.of("https://map.example.org", "http://localhost:3000", "chrome-extension://abcdef")),
                    NAMES)
            .servedAs("192.168.7.5", "source.example.org", null, "0.0.0.0/0 is not a host")
            .withProbes("/health", "/ready");

    /** Returns a request that arrived at 10.1.2.3, as on a server that listens on all addresses. */
    private static HttpCall call(String method, String target, boolean secure, Map<String, List<String>> headers) {
        return Unchecked.get(() -> new HttpCall(
                method,
                target,
                secure,
                InetAddress.getByName("10.1.2.3"),
                name -> headers.getOrDefault(name.toLowerCase(Locale.ROOT), List.of())));
    }

    /** Parses header lines separated by {@code ;}, as in {@code Host: a; Origin: http://b}. */
    private static Map<String, List<String>> headers(String lines) {
        Map<String, List<String>> headers = new HashMap<>();
        Stream.of(lines.split(";"))
                .map(String::strip)
                .filter(line -> !line.isEmpty())
                .map(line -> line.split(":", 2))
                .forEach(line -> headers.merge(
                        line[0].toLowerCase(Locale.ROOT),
                        List.of(line[1].strip()),
                        (some, more) ->
                                Stream.concat(some.stream(), more.stream()).toList()));
        return headers;
    }

    private static Decision decide(String requestLine, String lines) {
        String[] words = requestLine.split(" ");
        boolean secure = Arrays.asList(words).contains("tls");
        return RULE.decide(call(words[0], words[1], secure, headers(lines)));
    }

    @ParameterizedTest(name = "{0} | {1} | {2}")
    @CsvFileSource(resources = "/requests.txt", delimiter = '|')
    void decidesEachCaseOfTheTable(String requestLine, String headers, String expected) {
        Decision decision = decide(requestLine, headers == null ? "" : headers);

        String found = decision instanceof Decision.Refused refused
                ? refused.error()
                : decision.getClass().getSimpleName().toLowerCase(Locale.ROOT);
        assertThat(found).isEqualTo(expected);
    }

    @Test
    void namesTheValueAndTheOptionToSet() {
        assertThat(decide("GET /", "Host: Other.example.org:8085"))
                .isEqualTo(new Decision.Refused(
                        "foreign-host",
                        "this server is not known as 'other.example.org'; if it is, name that in --allowed-hosts"));
        assertThat(decide("GET /", "Host: localhost; Origin: https://evil.example:8443"))
                .isEqualTo(new Decision.Refused(
                        "foreign-origin",
                        "pages of https://evil.example:8443 may not use this server; if they may, name that in"
                                + " --allowed-origins"));
    }

    @Test
    void doesNotEchoAnInvalidHost() {
        assertThat(decide("GET /", "Host: <script>alert(1)</script>"))
                .isEqualTo(new Decision.Refused("foreign-host", "the request names no host that could be read"));
    }

    @Test
    void allowsAnAllowedPageToReadTheAnswer() {
        assertThat(decide("POST /api/domains", "Host: localhost; Origin: https://map.example.org"))
                .isEqualTo(new Decision.Granted(Map.of(
                        "Access-Control-Allow-Origin", "https://map.example.org",
                        "Vary", "Origin",
                        "Access-Control-Expose-Headers", "ETag, Link, Location, Retry-After")));
    }

    @Test
    void grantsThePreflightOfAnAllowedPage() {
        Decision decision = decide(
                "OPTIONS /api/domains",
                "Host: localhost; Origin: https://map.example.org; Access-Control-Request-Method: PUT;"
                        + "Access-Control-Request-Headers: authorization,content-type");

        assertThat(decision)
                .isEqualTo(new Decision.Preflight(Map.of(
                        "Access-Control-Allow-Origin", "https://map.example.org",
                        "Vary", "Origin",
                        "Access-Control-Allow-Methods", "PUT",
                        "Access-Control-Allow-Headers", "authorization,content-type",
                        "Access-Control-Max-Age", "600")));
    }

    @Test
    void acceptsOnlyTheAddressAtWhichTheConnectionArrived() throws UnknownHostException {
        HttpCall here = call("GET", "/", false, headers("Host: 10.1.2.3:8085"));
        HttpCall unknown = new HttpCall("GET", "/", false, null, here.headers());
        HttpCall linkLocal = new HttpCall(
                "GET",
                "/",
                false,
                InetAddress.getByName("fe80::1%1"),
                name -> headers("Host: [FE80:0::1]").getOrDefault(name.toLowerCase(Locale.ROOT), List.of()));

        assertThat(RULE.decide(here)).isInstanceOf(Decision.Granted.class);
        assertThat(RULE.decide(linkLocal)).isInstanceOf(Decision.Granted.class);
        assertThat(RULE.decide(unknown)).isInstanceOf(Decision.Refused.class);
    }

    @Test
    void decidesAlikeForMoreNamesThanItCaches() {
        for (int time = 0; time < 2; time++) {
            for (int port = 1; port <= 200; port++) {
                assertThat(decide("POST /notify", "Host: source.example.org:" + port))
                        .isInstanceOf(Decision.Granted.class);
                assertThat(decide("POST /notify", "Host: other.example.org:" + port))
                        .isInstanceOf(Decision.Refused.class);
            }
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "http://a", "a:80", "a:", "a b", "*", "a/b", "[::1", "1:2:3"})
    void rejectsAnInvalidAllowedHost(String host) {
        assertThatThrownBy(() -> new AllowedNames(List.of(host), List.of()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage(
                        "'" + host + "' is not a host: expected a name or an address without scheme and port, such as"
                                + " farm.example.org");
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "*", "null", "map.example.org", "https://", "https://a/", "https://a/b", "https://a b"})
    void rejectsAnInvalidAllowedOrigin(String origin) {
        assertThatThrownBy(() -> new AllowedNames(List.of(), List.of(origin)))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageStartingWith("'" + origin + "' is not an origin: expected scheme://host");
    }
}
