package io.furrow.http;

/** The names of a server's options for {@link AllowedNames}, used in rejections. */
public record OptionNames(String hosts, String origins) {
    /** Names of the command line. */
    public static final OptionNames FLAGS = new OptionNames("--allowed-hosts", "--allowed-origins");
}
