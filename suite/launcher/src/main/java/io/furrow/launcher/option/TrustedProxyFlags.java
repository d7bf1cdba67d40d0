package io.furrow.launcher.option;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;

import io.furrow.dashboard.auth.AddressRange;
import io.furrow.dashboard.auth.TrustedProxy;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.model.control.Role;
import io.furrow.model.file.FileProblem;

/** Options for a trusted proxy in front of the dashboard that signs users in, and for its headers. */
public final class TrustedProxyFlags {
    private static final Map<String, Role> GROUPS =
            Map.of("viewer", Role.VIEWER, "operator", Role.OPERATOR, "admin", Role.ADMIN);

    @Option(
            names = "--trusted-proxy",
            paramLabel = "ADDRESS,…",
            split = ",",
            hideParamSyntax = true,
            description =
                    "Addresses, or blocks such as 10.0.0.0/24, of a proxy that authenticates users and names them in "
                            + "headers. Headers from elsewhere are ignored. Every process that can connect from there can be any "
                            + "user. Needs --proxy-token-file.")
    private List<String> addresses;

    @Option(
            names = "--proxy-token-file",
            paramLabel = "FILE",
            description =
                    "File with the dashboard's own token, with which it acts at the control plane for users of the "
                            + "trusted proxy. Its line in --api-tokens of the control plane ends with 'for-users'.")
    private Path token;

    @Option(
            names = "--user-header",
            paramLabel = "NAME",
            description = "Header in which the trusted proxy names the user. Default: ${DEFAULT-VALUE}.")
    private String userHeader = "X-Forwarded-User";

    @Option(
            names = "--groups-header",
            paramLabel = "NAME",
            description = "Header in which the trusted proxy names the user's groups. Default: ${DEFAULT-VALUE}.")
    private String groupsHeader = "X-Forwarded-Groups";

    @Option(
            names = "--group-roles",
            paramLabel = "GROUP=ROLE,…",
            split = ",",
            hideParamSyntax = true,
            description =
                    "Role of the members of a group: viewer, operator or admin; of several the highest. A user without "
                            + "any is refused. Default: viewer=viewer,operator=operator,admin=admin.")
    private Map<String, String> groupRoles;

    @Option(
            names = "--sign-in-url",
            paramLabel = "URL",
            description =
                    "Path or URL to which the page redirects a user who is not signed in; {page} is the address to "
                            + "return to, for instance /oauth2/start?rd={page}. Default: none; the page asks for a token.")
    private String signIn;

    @Option(
            names = "--sign-out-url",
            paramLabel = "URL",
            description =
                    "Path or URL to which the page redirects after signing out, for instance /oauth2/sign_out. Default: "
                            + "none.")
    private String signOut;

    /** Adds the proxy's addresses to sign in and out. */
    public PageSettings pages(PageSettings page) {
        return page.withSignIn(checked("--sign-in-url", signIn), checked("--sign-out-url", signOut));
    }

    private static String checked(String option, String url) {
        if (url != null && !url.matches("(https?:/)?/[^/\\\\].*")) {
            throw new IllegalArgumentException(
                    "%s %s is neither a path, such as /oauth2/start, nor an http(s) URL".formatted(option, url));
        }
        return url;
    }

    /** Null without a trusted proxy. */
    public TrustedProxy proxy(CommandSpec spec) {
        if (addresses == null) {
            if (token != null) {
                throw new ParameterException(spec.commandLine(), "--proxy-token-file needs --trusted-proxy.");
            }
            return null;
        }
        if (token == null) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--trusted-proxy needs --proxy-token-file: the dashboard asks the control plane for the proxy's users with a token of its own.");
        }
        try {
            return new TrustedProxy(
                    addresses.stream().map(AddressRange::parse).toList(),
                    userHeader,
                    groupsHeader,
                    roles(),
                    read(token));
        } catch (IllegalArgumentException e) {
            throw new ParameterException(spec.commandLine(), "--trusted-proxy: " + e.getMessage() + ".", e);
        } catch (IOException e) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--proxy-token-file: %s cannot be read: %s.".formatted(token, FileProblem.of(e)),
                    e);
        }
    }

    private Map<String, Role> roles() {
        if (groupRoles == null) {
            return GROUPS;
        }
        Map<String, Role> roles = new HashMap<>();
        groupRoles.forEach((group, code) -> {
            Role role = GROUPS.get(code);
            if (role == null) {
                throw new IllegalArgumentException(
                        "'%s' is not a role for the group '%s'; it is viewer, operator or admin"
                                .formatted(code, group));
            }
            roles.put(group, role);
        });
        return roles;
    }

    private static String read(Path file) throws IOException {
        String token = Files.readString(file).strip();
        if (token.isEmpty() || token.chars().anyMatch(Character::isWhitespace)) {
            throw new IllegalArgumentException("the file %s holds one token and nothing else".formatted(file));
        }
        return token;
    }
}
