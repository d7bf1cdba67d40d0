package io.furrow.control.rest;

import org.eclipse.jetty.server.Handler;

import io.furrow.http.AccessRule;
import io.furrow.http.OptionNames;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;

/** The access rule in front of a port of the REST API. Tokens are no exemption: a page may know one that its reader typed. */
final class ApiAccess {
    private static final OptionNames OPTIONS = new OptionNames("--allowed-hosts", "--allowed-origins");

    private ApiAccess() {}

    static Handler guard(RestSettings rest, Handler handler) {
        AccessRule rule = AccessRule.allowing(rest.allowed(), OPTIONS)
                .servedAs(rest.host())
                .withProbes("/health", "/ready");
        return new AccessHandler(rule, refused -> problem(refused.error(), refused.reason()), handler);
    }

    /** An error that does not come from Jersey, in the same shape. */
    static byte[] problem(String error, String reason) {
        return NgsiJson.write(CommandResult.of(CommandResult.ERROR)
                .with("error", error)
                .with("reason", reason)
                .json());
    }
}
