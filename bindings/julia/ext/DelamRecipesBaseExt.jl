# SPDX-License-Identifier: BSD-3-Clause
"""
Plots of histories and of what lies on an interface, where RecipesBase (with Plots, for instance) is loaded:

    plot(history, "reaction:load")                     # over time; several names, several lines
    plot(history, ["dissipated", "work"]; over="load:load")
    plot(profile(solver, "adhesion", glue))
"""
module DelamRecipesBaseExt

using Delam
using RecipesBase

@recipe function f(history::Delam.History, names; over="time")
    series = names isa AbstractString ? [names] : collect(names)
    xguide --> over
    if length(series) == 1
        yguide --> series[1]
        legend --> false
    end
    for name in series
        @series begin
            seriestype --> :path
            label --> name
            (history[over], history[name])
        end
    end
end

@recipe function f(profile::Delam.Profile)
    if isempty(profile.lines)
        seriestype --> :scatter
        marker_z --> profile.values
        label --> profile.key
        return (profile.places[1, :], profile.places[2, :], profile.places[3, :])
    end
    xguide --> "place along the interface"
    yguide --> profile.key
    legend --> false
    for line in profile.lines
        @series begin
            seriestype --> :path
            (Delam.along_line(profile, line), profile.values[line])
        end
    end
end

end
