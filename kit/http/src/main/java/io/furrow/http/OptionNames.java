package io.furrow.http;

/** How a server calls the options of {@link AllowedNames}, for refusals that say what to set. */
public record OptionNames(String hosts, String origins) {
    /** Of the command line. */
    public static final OptionNames FLAGS = new OptionNames("--allowed-hosts", "--allowed-origins");
}
