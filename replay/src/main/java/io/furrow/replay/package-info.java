/** The job that plays stored missions back. */
package io.furrow.replay;
