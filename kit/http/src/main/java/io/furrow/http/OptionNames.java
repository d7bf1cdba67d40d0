package io.furrow.http;

/** How a server calls the options of {@link AllowedNames}, for refusals that say what to set. */
public record OptionNames(String hosts, String origins) {}
