package io.furrow.suite.page;

import java.net.URI;
import java.net.URLDecoder;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.regex.Pattern;

import com.microsoft.playwright.Route;
import com.microsoft.playwright.assertions.LocatorAssertions;
import com.microsoft.playwright.options.AriaRole;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.dashboard.auth.AddressRange;
import io.furrow.dashboard.auth.TrustedProxy;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.kafka.Readiness;
import io.furrow.model.control.Role;

import static com.microsoft.playwright.assertions.PlaywrightAssertions.assertThat;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.awaitility.Awaitility.await;

/** Sessions that end while the page is used, with tokens and behind a proxy that signs users in. */
@PageTest
@Tag("full")
class SignInIT {
    private static final String VERA = "vera-looks-at-the-farm-0002";
    private static final String VERA_LATER = "vera-looks-at-the-farm-0003";
    private static final String DASHBOARD = "the-dashboards-own-token-2";
    private static final Pattern MISSIONS = Pattern.compile(".*#/missions$");

    private Path tokens;
    private Properties client;

    @AutoClose
    private RestApi api;

    private volatile boolean signedIn;

    @BeforeEach
    void startControlPlaneWithTokens(PageSuite suite, @TempDir Path folder) throws Exception {
        client = suite.running().suite().kafka().clientProperties();
        tokens = folder.resolve("tokens");
        writeTokens("vera %s viewer%ndashboard %s admin for-users%n".formatted(VERA, DASHBOARD));
        api = RestApi.start(
                ControlSettings.of(client), RestSettings.on(0).withTokens(tokens), new Readiness(Clock.systemUTC()));
        await().until(api::isReady);
    }

    private void writeTokens(String lines) throws Exception {
        Files.writeString(tokens, lines);
    }

    private DashboardSettings settings() {
        return DashboardSettings.of(0, client, api.uri());
    }

    @Test
    void requestsATokenAgainWhenItIsRevokedAndReturnsToTheSameView(PageSuite suite) throws Exception {
        try (Dashboard dashboard = Dashboard.start(settings())) {
            FarmPage farm = suite.window(dashboard.uri(), WindowStyle.DESKTOP)
                    .expectingError("status of 401|status of 404.*images");
            farm.page().navigate(dashboard.uri().resolve("/#/missions").toString());
            signIn(farm, VERA);
            assertThat(farm.find("furrow-missions h1")).isVisible();

            writeTokens("vera %s viewer%n".formatted(VERA_LATER));

            assertThat(farm.page().getByRole(AriaRole.ALERT))
                    .hasText("The control plane does not know this token.", aMinute());
            signIn(farm, VERA_LATER);
            assertThat(farm.find("furrow-missions h1")).isVisible();
            assertThat(farm.page()).hasURL(MISSIONS);
            farm.close();
        }
    }

    private static void signIn(FarmPage farm, String token) {
        farm.page().getByLabel("Access token").fill(token);
        farm.button("Sign in").click();
    }

    private static LocatorAssertions.HasTextOptions aMinute() {
        return new LocatorAssertions.HasTextOptions().setTimeout(60_000);
    }

    @Test
    void redirectsToTheSignInOfAProxyAndBackAndToItsSignOut(PageSuite suite) throws Exception {
        TrustedProxy proxy = new TrustedProxy(
                List.of(AddressRange.parse("127.0.0.1")),
                "X-Forwarded-User",
                "X-Forwarded-Groups",
                Map.of("drivers", Role.OPERATOR),
                DASHBOARD);
        PageSettings pages = PageSettings.DEFAULT.withSignIn("/oauth2/start?rd={page}", "/oauth2/sign_out?rd={page}");
        try (Dashboard dashboard = Dashboard.start(settings().withProxy(proxy).withPage(pages))) {
            FarmPage farm = suite.window(dashboard.uri(), WindowStyle.DESKTOP)
                    .expectingError("status of 401|status of 404.*images");
            farm.page().route("**/*", this::asTheProxy);
            farm.open("").go("Missions");
            assertThat(farm.find("furrow-missions h1")).isVisible();

            signedIn = false;
            farm.run("void import('/core/api.js').then(({ api }) => api.get('/api/missions')).catch(() => {})"); // not
            // awaited: it leaves the page
            farm.until(() -> signedIn); // lets the mocked proxy answer
            assertThat(farm.find("furrow-missions h1")).isVisible();
            assertThat(farm.page()).hasURL(MISSIONS);

            farm.button("Settings").click();
            assertThat(farm.find("#settings")).containsText("olga · operator");
            farm.button("Sign out").click();
            assertThat(farm.page().getByText("Signed out, back to /")).isVisible();
        }
    }

    @Test
    void doesNotRedirectInALoopIfOnlyTheProxyAcceptsTheUser(PageSuite suite) throws Exception {
        PageSettings pages = PageSettings.DEFAULT.withSignIn("/oauth2/start?rd={page}", null);
        try (Dashboard dashboard = Dashboard.start(settings().withPage(pages))) {
            FarmPage farm = suite.window(dashboard.uri(), WindowStyle.DESKTOP)
                    .expectingError("status of 401|status of 404.*images");
            farm.page().route("**/*", this::asTheProxy);
            farm.page().navigate(dashboard.uri().resolve("/").toString());

            assertThat(farm.page().getByRole(AriaRole.ALERT)).containsText("The proxy has not signed you in");
            assertThat(farm.button("Sign in again")).isVisible();
            farm.page().getByLabel("Access token").fill(VERA);
            farm.button("Use the token").click();
            assertThat(farm.find("furrow-app")).isVisible();
        }
    }

    /**
     * Behaves like oauth2-proxy: answers requests for JSON with 401, and redirects others to the pages of the proxy.
     */
    private void asTheProxy(Route route) {
        URI uri = URI.create(route.request().url());
        boolean asksForJson =
                String.valueOf(route.request().headers().get("accept")).contains("application/json");
        if (uri.getPath().equals("/oauth2/start")) {
            signedIn = true;
            redirect(route, URLDecoder.decode(uri.getRawQuery().substring("rd=".length()), UTF_8));
        } else if (uri.getPath().equals("/oauth2/sign_out")) {
            signedIn = false;
            route.fulfill(new Route.FulfillOptions()
                    .setContentType("text/plain")
                    .setBody("Signed out, back to " + uri.getQuery().substring("rd=".length())));
        } else if (!signedIn && asksForJson && !uri.getPath().equals("/config.json")) {
            route.fulfill(new Route.FulfillOptions()
                    .setStatus(401)
                    .setContentType("application/json")
                    .setBody("{}"));
        } else if (!signedIn && !asksForJson) {
            redirect(route, "/oauth2/start?rd=" + uri.getPath());
        } else {
            Map<String, String> headers = new HashMap<>(route.request().headers());
            headers.put("X-Forwarded-User", "olga");
            headers.put("X-Forwarded-Groups", "drivers");
            route.resume(new Route.ResumeOptions().setHeaders(headers));
        }
    }

    /** Redirects by a page, because Playwright does not route requests that follow an HTTP redirect. */
    private static void redirect(Route route, String where) {
        route.fulfill(new Route.FulfillOptions()
                .setContentType("text/html")
                .setBody("<script>location.replace('%s')</script>".formatted(where)));
    }
}
