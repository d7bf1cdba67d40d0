package io.furrow.dashboard.auth;

import java.net.InetAddress;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.control.Role;

/**
 * A proxy in front of the dashboard that signs users in, with OpenID Connect for instance, and names them in headers.
 * Headers of other senders are ignored. The dashboard then sends requests to the control plane with its own token, on
 * behalf of the user.
 *
 * @param addresses from which the proxy connects
 * @param userHeader with the name of the user
 * @param groupsHeader with the user's groups, separated by {@code ,} or {@code
 * }
 * @param roles of groups; of several groups the highest role counts
 * @param token of the dashboard, which has {@code for-users} in the control plane's file of tokens
 */
public record TrustedProxy(
        List<AddressRange> addresses, String userHeader, String groupsHeader, Map<String, Role> roles, String token) {
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_.@-]{1,64}");

    public TrustedProxy {
        addresses = List.copyOf(addresses);
        roles = Map.copyOf(roles);
        Objects.requireNonNull(userHeader);
        Objects.requireNonNull(groupsHeader);
        Objects.requireNonNull(token);
    }

    boolean isAt(InetAddress address) {
        return address != null && addresses.stream().anyMatch(each -> each.contains(address));
    }

    /**
     * The user that the proxy names.
     *
     * @param names values of the user header
     * @param groups values of the groups header
     * @throws Problem 403 if the user's name is missing, repeated or invalid, or the user has no role
     */
    User user(List<String> names, List<String> groups) {
        if (names.size() != 1) {
            throw new Problem(
                    403,
                    "wrong-user",
                    "the proxy sends %s %d times instead of once".formatted(userHeader, names.size()));
        }
        String name = names.get(0).strip();
        if (!NAME.matcher(name).matches()) {
            throw new Problem(
                    403,
                    "wrong-user",
                    "%s must be a name of 1 to 64 characters of A-Z a-z 0-9 _ . @ -; --user-header selects another header"
                            .formatted(userHeader));
        }
        Role role = groups.stream()
                .flatMap(value -> Arrays.stream(value.split("[,|]")))
                .map(String::strip)
                .flatMap(group -> Stream.ofNullable(roles.get(group)))
                .max(Role::compareTo)
                .orElseThrow(() -> new Problem(
                        403,
                        "no-role",
                        "no group of '%s' has a role; --group-roles gives roles to groups (%s)"
                                .formatted(
                                        name,
                                        String.join(
                                                ", ",
                                                roles.keySet().stream().sorted().toList()))));
        return new User(name, role);
    }

    /** Leaves out the token. */
    @Override
    public String toString() {
        return "proxy at " + addresses;
    }
}
