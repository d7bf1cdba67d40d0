/** The analytics jobs; one package is one job is one question. */
package io.furrow.analytics;
